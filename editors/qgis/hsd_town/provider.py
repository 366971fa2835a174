# SPDX-License-Identifier: GPL-2.0-or-later
"""The provider of the algorithms, with the setting that says where the program is."""

import pathlib

from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .algorithms import ALGORITHMS


class Provider(QgsProcessingProvider):
    def id(self):
        return "hsd"

    def name(self):
        return "hsd"

    def icon(self):
        return QIcon(str(pathlib.Path(__file__).with_name("icon.svg")))

    def load(self):
        from processing.core.ProcessingConfig import ProcessingConfig, Setting
        ProcessingConfig.settingIcons["hsd"] = self.icon()
        ProcessingConfig.addSetting(Setting("hsd", "HSD_PROGRAM", "Program hsd (empty: that on the path)", "", valuetype=Setting.FILE))
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self):
        from processing.core.ProcessingConfig import ProcessingConfig
        ProcessingConfig.removeSetting("HSD_PROGRAM")

    def loadAlgorithms(self):
        for one in ALGORITHMS:
            self.addAlgorithm(one())
