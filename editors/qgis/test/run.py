# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of the Processing provider, in a QGIS without a window:

    HSD=/path/to/hsd QT_QPA_PLATFORM=offscreen /usr/bin/python3 run.py
"""

import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
TOWNS = HERE.parents[2] / "examples" / "towns"
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
WORK = pathlib.Path(tempfile.mkdtemp(prefix="hsd-qgis-"))
os.environ["QGIS_CUSTOM_CONFIG_PATH"] = str(WORK / "profile")
sys.path[:0] = ["/usr/share/qgis/python/plugins", str(HERE.parent)]

from qgis.core import (Qgis, QgsApplication, QgsFeature, QgsGeometry, QgsProcessingContext, QgsProcessingException,  # noqa: E402
                       QgsProcessingFeedback, QgsProject, QgsRasterLayer, QgsSettings, QgsVectorLayer)

application = QgsApplication([], False)
application.initQgis()
import processing  # noqa: E402
from processing.core.Processing import Processing  # noqa: E402
from processing.core.ProcessingConfig import ProcessingConfig  # noqa: E402

Processing.initialize()
import hsd_town  # noqa: E402
from hsd_town import algorithms, town, words  # noqa: E402

PROGRAM = os.environ.get("HSD") or shutil.which("hsd") or ""
plugin = hsd_town.classFactory(None)
plugin.initProcessing()
ProcessingConfig.setSettingValue("HSD_PROGRAM", PROGRAM)


class Told(QgsProcessingFeedback):
    """Keeps what is told."""

    def __init__(self):
        super().__init__(False)
        self.lines = []

    def pushInfo(self, line):
        self.lines.append(line)

    def pushWarning(self, line):
        self.lines.append(line)

    def reportError(self, line, fatalError=False):
        self.lines.append(line)

    def text(self):
        return "\n".join(self.lines)


def outlines(crs="EPSG:6674", shift=(-21000.0, -110000.0)):
    """Three houses in a row of plane zone VI of Japan, beside a lane, with a type for one of them."""
    houses = QgsVectorLayer(f"Polygon?crs={crs}&field=name:string&field=型:string&field=use:string", "houses", "memory")
    rows = [("a", None, "shop", 0, 6), ("b", "kura", "shop", 6.5, 13), ("c", None, "dwelling", 13.5, 20), ("d", None, "shed", 21, 23)]
    for name, kind, use, left, right in rows:
        feature = QgsFeature(houses.fields())
        depth = 3 if use == "shed" else 11
        ring = [(left, 0), (right, 0), (right, depth), (left, depth), (left, 0)]
        points = ", ".join(f"{x + shift[0]} {y + shift[1]}" for x, y in ring)
        feature.setGeometry(QgsGeometry.fromWkt(f"Polygon(({points}))"))
        feature.setAttributes([name, kind, use])
        houses.dataProvider().addFeature(feature)
    lane = QgsVectorLayer(f"LineString?crs={crs}&field=width:double", "lane", "memory")
    feature = QgsFeature(lane.fields())
    feature.setGeometry(QgsGeometry.fromWkt(f"LineString({shift[0] - 10} {shift[1] - 4}, {shift[0] + 40} {shift[1] - 4})"))
    feature.setAttributes([6.0])
    lane.dataProvider().addFeature(feature)
    QgsProject.instance().addMapLayers([houses, lane])
    return houses, lane


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=WORK))
        self.told = Told()
        QgsProject.instance().clear()

    def run_it(self, name, **parameters):
        self.context = QgsProcessingContext()
        self.context.setProject(QgsProject.instance())
        return processing.run(f"hsd:{name}", parameters, context=self.context, feedback=self.told)


class Provider(Case):
    def test_algorithms_are_there(self):
        provider = QgsApplication.processingRegistry().providerById("hsd")
        self.assertEqual(sorted(a.name() for a in provider.algorithms()), ["buildtown", "firsttown", "townfile"])
        self.assertFalse(provider.icon().isNull())

    def test_words_are_there_in_japanese(self):
        source = "".join((HERE.parent / "hsd_town" / f).read_text(encoding="utf-8") for f in ("algorithms.py",))
        said = set(re.findall(r'say\("([^"]+)"\)', source)) | {a.TITLE for a in algorithms.ALGORITHMS} | {a.HELP for a in algorithms.ALGORITHMS}
        self.assertEqual(said - set(words._JA), set())
        QgsSettings().setValue("locale/userLocale", "ja_JP")
        try:
            self.assertEqual(algorithms.BuildTown().displayName(), "町を建てる")
        finally:
            QgsSettings().remove("locale/userLocale")


class Build(Case):
    def test_layers_fields_and_types(self):
        houses, lane = outlines()
        done = self.run_it("buildtown", HOUSES=houses, STREETS=[lane], KEY="name", TYPE="型", FIELDS=["use", "kind"],
                           RULES=["kind = 'dwelling'", "shimotaya", "", "", "so-nikai", "2", "", "chu-nikai", "1"],
                           SEED=3, DETAIL=1, OUTPUT=str(self.folder / "town"), DECISIONS="memory:")
        rows = {f["name"]: f for f in done["DECISIONS"].getFeatures()}
        self.assertEqual((rows["b"]["hsd_type"], rows["c"]["hsd_type"], rows["d"]["hsd_why"]), ("kura", "shimotaya", "a shed"), self.told.text())
        self.assertIn(rows["a"]["hsd_type"], ("so-nikai", "chu-nikai"))
        self.assertIn("frontage=", rows["a"]["hsd_parameters"])
        self.assertEqual(done["DECISIONS"].crs().authid(), "EPSG:6674")
        tileset = pathlib.Path(done["TILESET"])
        self.assertTrue(tileset.is_file())
        self.assertIn("transform", tileset.read_text())
        self.assertIn("hsd_type = 'kura'", pathlib.Path(done["TOWN"]).read_text(encoding="utf-8"))
        if Qgis.QGIS_VERSION_INT < 33400:
            self.assertIn("3.34", self.told.text())

    def test_the_key_may_be_missing(self):
        houses, lane = outlines()
        done = self.run_it("buildtown", HOUSES=houses, STREETS=[lane], RULES=["", "hiraya", ""], DETAIL=1, OUTPUT=str(self.folder / "t"), DECISIONS="memory:")
        self.assertEqual([f["hsd_type"] for f in done["DECISIONS"].getFeatures()][:3], ["hiraya"] * 3)

    def test_a_ground(self):
        house_file, road_file, grid = (TOWNS / f for f in ("hill-houses.geojson", "hill-roads.geojson", "hill.asc"))
        houses, roads = QgsVectorLayer(str(house_file), "houses", "ogr"), QgsVectorLayer(str(road_file), "roads", "ogr")
        ground = QgsRasterLayer(str(grid), "ground")
        for layer in (houses, roads, ground):
            layer.setCrs(algorithms.QgsCoordinateReferenceSystem())
        QgsProject.instance().addMapLayers([houses, roads, ground])
        done = self.run_it("buildtown", HOUSES=houses, STREETS=[roads], GROUND=ground, RULES=town.RULES, DETAIL=1, OUTPUT=str(self.folder / "t"), DECISIONS="memory:")
        self.assertIn("globe", self.told.text())
        self.assertTrue(list((pathlib.Path(done["TILESET"]).parent / "tiles").glob("ground-*")))

    def test_a_wrong_rule_is_told_with_line_and_fix(self):
        houses, lane = outlines()
        with self.assertRaises(QgsProcessingException) as raised:
            self.run_it("buildtown", HOUSES=houses, STREETS=[lane], RULES=["", "so-nikia", ""], DETAIL=1, OUTPUT=str(self.folder / "t"), DECISIONS="memory:")
        self.assertRegex(str(raised.exception), r"town\.hsd:\d+:\d+: error\[HSD\d+\].*so-nikai")

    def test_a_missing_program_is_told(self):
        gone = self.folder / "gone"
        gone.write_text("")
        ProcessingConfig.setSettingValue("HSD_PROGRAM", str(gone))
        gone.unlink()
        try:
            with self.assertRaisesRegex(QgsProcessingException, "gone: choose hsd"):
                self.run_it("townfile", TOWN=str(TOWNS / "block.hsd"), DETAIL=1, OUTPUT=str(self.folder))
        finally:
            ProcessingConfig.setSettingValue("HSD_PROGRAM", PROGRAM)


class Files(Case):
    def test_a_town_file_and_its_table(self):
        done = self.run_it("townfile", TOWN=str(TOWNS / "block.hsd"), DETAIL=1, OUTPUT=str(self.folder / "block"))
        self.assertTrue(pathlib.Path(done["TILESET"]).is_file())
        loaded = list(self.context.layersToLoadOnCompletion())
        self.assertEqual(len(loaded), 1)
        layer = self.context.temporaryLayerStore().mapLayer(loaded[0])
        self.assertEqual(layer.featureCount(), 17)
        self.assertIn("why", layer.fields().names())

    def test_a_first_town_builds(self):
        houses, lane = outlines()
        path = self.folder / "first.hsd"
        self.run_it("firsttown", LAYERS=[houses, lane], TOWN=str(path))
        self.assertIn('<Layer name="houses"', path.read_text(encoding="utf-8"))
        done = self.run_it("townfile", TOWN=str(path), DETAIL=1, OUTPUT=str(self.folder / "tiles"))
        self.assertIn("transform", pathlib.Path(done["TILESET"]).read_text())
        with self.assertRaisesRegex(QgsProcessingException, "first.hsd"):
            self.run_it("firsttown", LAYERS=[houses, lane], TOWN=str(path))

    def test_tiles_are_loaded_where_qgis_can(self):
        asked = []

        def stand_in(path, name):
            asked.append((pathlib.Path(path).name, name))
            return QgsVectorLayer("Point", name, "memory")

        before, algorithms.tiles_layer = algorithms.tiles_layer, stand_in
        try:
            self.run_it("townfile", TOWN=str(TOWNS / "block.hsd"), DETAIL=1, OUTPUT=str(self.folder / "block"))
        finally:
            algorithms.tiles_layer = before
        self.assertEqual(asked, [("tileset.json", "block")])
        self.assertEqual(len(list(self.context.layersToLoadOnCompletion())), 2)


if __name__ == "__main__":
    if not PROGRAM:
        sys.exit("no hsd: set HSD to the program")
    suite = unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"])
    well = unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful()
    shutil.rmtree(WORK, ignore_errors=True)
    print(f"QGIS {Qgis.QGIS_VERSION}")
    sys.stdout.flush()
    # Qt would end with what is left of Python's layers.
    os._exit(0 if well else 1)
