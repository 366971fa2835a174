# SPDX-License-Identifier: GPL-2.0-or-later
"""Towns of hsd in QGIS: a Processing provider."""


class Plugin:
    def __init__(self):
        self.provider = None

    def initProcessing(self):
        from qgis.core import QgsApplication

        from .provider import Provider
        self.provider = Provider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        from qgis.core import QgsApplication
        QgsApplication.processingRegistry().removeProvider(self.provider)


def classFactory(_iface):
    return Plugin()
