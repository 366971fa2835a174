# SPDX-License-Identifier: GPL-2.0-or-later
"""Algorithms: a town from layers, fields and types; a first town of `hsd town init`; a town file."""

import csv
import pathlib
import shutil

from qgis.core import (NULL, Qgis, QgsCoordinateReferenceSystem, QgsCoordinateTransform, QgsFeature, QgsFeatureSink, QgsField,
                       QgsProcessing, QgsProcessingAlgorithm, QgsProcessingContext, QgsProcessingException,
                       QgsProcessingOutputFile, QgsProcessingParameterEnum, QgsProcessingParameterFeatureSink,
                       QgsProcessingParameterFeatureSource, QgsProcessingParameterField, QgsProcessingParameterFile,
                       QgsProcessingParameterFileDestination, QgsProcessingParameterFolderDestination,
                       QgsProcessingParameterMatrix, QgsProcessingParameterMultipleLayers, QgsProcessingParameterNumber,
                       QgsProcessingParameterRasterLayer, QgsVectorFileWriter, QgsVectorLayer, QgsWkbTypes)
from qgis.PyQt.QtCore import QVariant

from . import program, town
from .words import language, say

DETAILS = ["", "0", "0,1", "0,1,3"]
TOLD = ["type", "what", "why", "rule", "parameters", "measures"]


def program_path():
    from processing.core.ProcessingConfig import ProcessingConfig
    return program.find(ProcessingConfig.getSetting("HSD_PROGRAM") or "")


def told(feature, field):
    """The text in a field of a feature; empty where the field or its value is missing."""
    value = feature[field] if field else None
    return "" if value is None or value == NULL else str(value).strip()


def key_of(feature, field):
    """The key of a feature in the town: that of the field, or its number."""
    return told(feature, field) or str(feature.id())


def write_layer(layer, path, context, key=None, types=None):
    """Writes a layer as GeoJSON in degrees, or in its own metres where it has no system. Whether it has none.

    Without a field for it the key is the number of the feature; `types` names the field with house types."""
    local = not layer.crs().isValid()
    options = QgsVectorFileWriter.SaveVectorOptions()
    options.driverName = "GeoJSON"
    # Nine digits of a degree are a tenth of a millimetre.
    options.layerOptions = ["COORDINATE_PRECISION=9"]
    if not local:
        options.ct = QgsCoordinateTransform(layer.crs(), QgsCoordinateReferenceSystem("EPSG:4326"), context.transformContext())
    source = layer
    if key is not None or types:
        source = QgsVectorLayer(QgsWkbTypes.displayString(layer.wkbType()), "copy", "memory")
        source.setCrs(layer.crs())
        data = source.dataProvider()
        # Fields of a layer that this algorithm has written before.
        kept = [f for f in layer.fields() if f.name() not in ("hsd_key", "hsd_type")]
        data.addAttributes([QgsField("hsd_key", QVariant.String), QgsField("hsd_type", QVariant.String), *kept])
        source.updateFields()
        copies = []
        for feature in layer.getFeatures():
            copy = QgsFeature(source.fields())
            copy.setGeometry(feature.geometry())
            copy.setAttributes([key_of(feature, key), told(feature, types) or None, *[feature[f.name()] for f in kept]])
            copies.append(copy)
        data.addFeatures(copies)
    done = QgsVectorFileWriter.writeAsVectorFormatV3(source, str(path), context.transformContext(), options)
    if done[0] != QgsVectorFileWriter.NoError:
        raise QgsProcessingException(f"{layer.name()}: {done[1]}")
    return local


def tiles_layer(path, name):
    """The layer of a tileset; None in a QGIS that has none."""
    if Qgis.QGIS_VERSION_INT < 33400:
        return None
    from qgis.core import QgsTiledSceneLayer
    return QgsTiledSceneLayer(str(path), name, "cesiumtiles")


def read_decisions(path):
    with open(path, encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


class Base(QgsProcessingAlgorithm):
    """What the algorithms have in common: the program, its messages, and loading what it has made."""

    def createInstance(self):
        return type(self)()

    def name(self):
        return self.ID

    def displayName(self):
        return say(self.TITLE)

    def shortHelpString(self):
        return say(self.HELP)

    def build(self, source, out, detail, feedback):
        """Builds a town and tells what hsd says of it; errors end the algorithm."""
        def progress(done, of):
            feedback.setProgress(10 + 80 * done / max(of, 1))

        said, tileset, table = program.build(program_path(), source, out, DETAILS[detail], language(), feedback.pushInfo, progress,
                                             feedback.isCanceled)
        for message in said:
            tell = feedback.reportError if message["severity"] == "error" else feedback.pushInfo
            tell(program.line_of(message))
        if tileset is None:
            errors = [m for m in said if m["severity"] == "error"]
            raise QgsProcessingException(program.line_of((errors or said)[0]))
        return tileset, table

    def show_tiles(self, tileset, name, context, feedback):
        layer = tiles_layer(tileset, name)
        if layer is None:
            feedback.pushWarning(say("QGIS shows 3D Tiles from version 3.34 on; look at them with: hsd view") + f" {tileset.parent}")
            return
        if not layer.isValid():
            feedback.pushWarning(f"{tileset}: {layer.error().summary() if layer.error() else ''}")
            return
        context.temporaryLayerStore().addMapLayer(layer)
        context.addLayerToLoadOnCompletion(layer.id(), QgsProcessingContext.LayerDetails(name, context.project(), "TILESET"))

    def processAlgorithm(self, parameters, context, feedback):
        try:
            return self.work(parameters, context, feedback)
        except program.Failure as failure:
            raise QgsProcessingException(str(failure)) from failure


class BuildTown(Base):
    ID = "buildtown"
    TITLE = "Build town"
    HELP = ("Builds a house on each outline of a layer, as 3D Tiles, and tells in a layer what was built and why. A field may "
            "name the type of each house; the rules decide on the others: the first test that holds, then by share. Tests "
            "may use fields and measures (area, frontage, depth, kind = 'shop'). The town is written beside the tiles as "
            "town.hsd, to be changed by hand.")

    def initAlgorithm(self, _config=None):
        add = self.addParameter
        add(QgsProcessingParameterFeatureSource("HOUSES", say("Outlines of houses, or lots"), [QgsProcessing.TypeVectorPolygon]))
        add(QgsProcessingParameterMultipleLayers("STREETS", say("Streets"), QgsProcessing.TypeVectorAnyGeometry, optional=True))
        add(QgsProcessingParameterRasterLayer("GROUND", say("Heights of the ground (GeoTIFF or ESRI grid)"), optional=True))
        add(QgsProcessingParameterField("KEY", say("Field with the key"), parentLayerParameterName="HOUSES", optional=True))
        add(QgsProcessingParameterField("TYPE", say("Field with the house type"), parentLayerParameterName="HOUSES", optional=True))
        add(QgsProcessingParameterMatrix("FIELDS", say("Fields by other names"), headers=[say("Field"), say("Name in tests and types")], defaultValue=[], optional=True))
        add(QgsProcessingParameterMatrix("RULES", say("Types"), headers=[say("Test"), say("Type"), say("Share")], defaultValue=town.RULES))
        add(QgsProcessingParameterNumber("SEED", say("Seed"), defaultValue=1, minValue=0))
        add(detail_parameter())
        add(QgsProcessingParameterFolderDestination("OUTPUT", say("Folder of the town")))
        add(QgsProcessingParameterFeatureSink("DECISIONS", say("Decisions"), QgsProcessing.TypeVectorPolygon))
        self.addOutput(QgsProcessingOutputFile("TILESET", say("3D Tiles")))
        self.addOutput(QgsProcessingOutputFile("TOWN", say("Town file")))

    def work(self, parameters, context, feedback):
        houses = self.parameterAsVectorLayer(parameters, "HOUSES", context)
        if houses is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, "HOUSES"))
        key = next(iter(self.parameterAsFields(parameters, "KEY", context)), "")
        types = next(iter(self.parameterAsFields(parameters, "TYPE", context)), "")
        out = pathlib.Path(self.parameterAsString(parameters, "OUTPUT", context))
        maps = out / "maps"
        maps.mkdir(parents=True, exist_ok=True)
        local = write_layer(houses, maps / "houses.geojson", context, key, types)
        fields = town.rows(self.parameterAsMatrix(parameters, "FIELDS", context), 2)
        layers = town.layer("houses", "maps/houses.geojson", "hsd_key", fields, local)
        streets = self.parameterAsLayerList(parameters, "STREETS", context)
        for number, layer in enumerate(streets):
            name = "roads" if number == 0 else f"roads{number + 1}"
            plain = write_layer(layer, maps / f"{name}.geojson", context)
            layers += town.layer(name, f"maps/{name}.geojson", local=plain)
        ground = self.parameterAsRasterLayer(parameters, "GROUND", context)
        if ground is not None:
            file = pathlib.Path(ground.source().split("|")[0])
            copy = maps / f"ground{file.suffix.lower()}"
            shutil.copy(file, copy)
            layers += town.layer("ground", f"maps/{copy.name}", local=not ground.crs().isValid())
        named = sorted({told(f, types) for f in houses.getFeatures()} - {""})
        rules = town.rows(self.parameterAsMatrix(parameters, "RULES", context), 3)
        text = town.text(houses.name(), self.parameterAsInt(parameters, "SEED", context), layers, rules, named)
        source = out / "town.hsd"
        source.write_text(text, encoding="utf-8")
        tileset, table = self.build(source, out / "tiles", self.parameterAsEnum(parameters, "DETAIL", context), feedback)
        if local:
            feedback.pushWarning(say("The layer has no coordinate reference system, so the tiles stand nowhere on the globe"))
        sink = self.write_decisions(parameters, context, houses, key, table)
        self.show_tiles(tileset, houses.name(), context, feedback)
        return {"OUTPUT": str(out), "TILESET": str(tileset), "TOWN": str(source), "DECISIONS": sink}

    def write_decisions(self, parameters, context, houses, key, table):
        """The outlines with what the table says of them, joined by the key."""
        decided = {}
        for row in read_decisions(table):
            if row["layer"] == "houses":
                decided.setdefault(row["key"], row)
        fields = houses.fields()
        for name in TOLD:
            fields.append(QgsField(f"hsd_{name}", QVariant.String))
        sink, address = self.parameterAsSink(parameters, "DECISIONS", context, fields, houses.wkbType(), houses.crs())
        for feature in houses.getFeatures():
            row = decided.get(key_of(feature, key), {})
            copy = QgsFeature(fields)
            copy.setGeometry(feature.geometry())
            copy.setAttributes(feature.attributes() + [row.get(name, "") for name in TOLD])
            sink.addFeature(copy, QgsFeatureSink.FastInsert)
        return address


def detail_parameter():
    names = ["As the town says (0, 1, 3)", "0: walls and roofs", "0 and 1: pictures of parts", "0, 1 and 3: everything"]
    return QgsProcessingParameterEnum("DETAIL", say("Levels of detail"), options=[say(n) for n in names], defaultValue=2)


class FirstTown(Base):
    ID = "firsttown"
    TITLE = "Write a first town"
    HELP = ("Writes a town file from layers: what each is, and what its fields mean, is found from their names and values. "
            "Read its comments, change it, and build it as a town file.")

    def initAlgorithm(self, _config=None):
        self.addParameter(QgsProcessingParameterMultipleLayers("LAYERS", say("Layers"), QgsProcessing.TypeVectorAnyGeometry))
        self.addParameter(QgsProcessingParameterFileDestination("TOWN", say("Town file"), "hsd (*.hsd)"))

    def work(self, parameters, context, feedback):
        path = pathlib.Path(self.parameterAsFileOutput(parameters, "TOWN", context))
        if path.exists():
            raise QgsProcessingException(f"{path}: " + say("is there already, and may have been changed by hand"))
        maps = path.with_name(f"{path.stem}-maps")
        maps.mkdir(parents=True, exist_ok=True)
        files = []
        for number, layer in enumerate(self.parameterAsLayerList(parameters, "LAYERS", context)):
            plain = "".join(c if c.isalnum() else "-" for c in layer.name()).strip("-") or "layer"
            file = maps / f"{plain}.geojson"
            if file in files:
                file = maps / f"{plain}-{number + 1}.geojson"
            write_layer(layer, file, context)
            files.append(file)
        status = program.run([program_path(), "town", "init", "--lang", language(), *files, "-o", path], feedback.pushInfo, feedback.isCanceled)
        if status != 0:
            raise QgsProcessingException(f"hsd town init: {status}")
        return {"TOWN": str(path)}


class TownFile(Base):
    ID = "townfile"
    TITLE = "Build a town file"
    HELP = "Builds a town file (.hsd) as 3D Tiles and loads them with the table that tells for each feature what was built on it and why."

    def initAlgorithm(self, _config=None):
        self.addParameter(QgsProcessingParameterFile("TOWN", say("Town file"), extension="hsd"))
        self.addParameter(detail_parameter())
        self.addParameter(QgsProcessingParameterFolderDestination("OUTPUT", say("Folder of the tiles")))
        self.addOutput(QgsProcessingOutputFile("TILESET", say("3D Tiles")))
        self.addOutput(QgsProcessingOutputFile("DECISIONS", say("Decisions")))

    def work(self, parameters, context, feedback):
        source = pathlib.Path(self.parameterAsFile(parameters, "TOWN", context))
        out = pathlib.Path(self.parameterAsString(parameters, "OUTPUT", context))
        tileset, table = self.build(source, out, self.parameterAsEnum(parameters, "DETAIL", context), feedback)
        layer = QgsVectorLayer(str(table), f"{source.stem} {say('Decisions')}", "ogr")
        if layer.isValid():
            context.temporaryLayerStore().addMapLayer(layer)
            context.addLayerToLoadOnCompletion(layer.id(), QgsProcessingContext.LayerDetails(layer.name(), context.project(), "DECISIONS"))
        self.show_tiles(tileset, source.stem, context, feedback)
        return {"OUTPUT": str(out), "TILESET": str(tileset), "DECISIONS": str(table)}


ALGORITHMS = (BuildTown, FirstTown, TownFile)
