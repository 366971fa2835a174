# SPDX-License-Identifier: GPL-2.0-or-later
"""The words of the algorithms in Japanese."""

from qgis.core import QgsSettings

_JA = {
    "Build town": "町を建てる",
    "Write a first town": "最初の町を書く",
    "Build a town file": "町のファイルを建てる",
    "Outlines of houses, or lots": "家の輪郭、または敷地",
    "Streets": "道",
    "Heights of the ground (GeoTIFF or ESRI grid)": "地面の高さ(GeoTIFF または ESRI グリッド)",
    "Field with the key": "キーのフィールド",
    "Field with the house type": "家のひな形のフィールド",
    "Fields by other names": "別の名で使うフィールド",
    "Field": "フィールド",
    "Name in tests and types": "条件とひな形での名",
    "Types": "ひな形",
    "Test": "条件",
    "Type": "ひな形",
    "Share": "割合",
    "Seed": "乱数の種",
    "Folder of the town": "町のフォルダー",
    "Folder of the tiles": "タイルのフォルダー",
    "Decisions": "判断",
    "3D Tiles": "3D Tiles",
    "Town file": "町のファイル",
    "Layers": "レイヤー",
    "Levels of detail": "詳細度",
    "As the town says (0, 1, 3)": "町の指定による(0, 1, 3)",
    "0: walls and roofs": "0: 壁と屋根",
    "0 and 1: pictures of parts": "0 と 1: 部材の画像",
    "0, 1 and 3: everything": "0、1、3: すべて",
    "is there already, and may have been changed by hand": "すでにあり、手で変えられているかもしれない",
    "The layer has no coordinate reference system, so the tiles stand nowhere on the globe": "レイヤーに座標参照系がないので、タイルは地球上のどこにも置かれない",
    "QGIS shows 3D Tiles from version 3.34 on; look at them with: hsd view": "QGIS が 3D Tiles を表示するのは 3.34 から。次で見られる: hsd view",
    ("Builds a house on each outline of a layer, as 3D Tiles, and tells in a layer what was built and why. A field may "
     "name the type of each house; the rules decide on the others: the first test that holds, then by share. Tests "
     "may use fields and measures (area, frontage, depth, kind = 'shop'). The town is written beside the tiles as "
     "town.hsd, to be changed by hand."):
        "レイヤーの輪郭それぞれに家を建てて 3D Tiles にし、何がなぜ建てられたかをレイヤーに示す。フィールドで家のひな形を指定できる。"
        "ほかの家は規則が決める: 最初に成り立つ条件、次に割合。条件にはフィールドと寸法が使える(area、frontage、depth、kind = 'shop')。"
        "町はタイルの横に town.hsd として書かれ、手で変えられる。",
    ("Writes a town file from layers: what each is, and what its fields mean, is found from their names and values. "
     "Read its comments, change it, and build it as a town file."):
        "レイヤーから町のファイルを書く。それぞれが何か、フィールドが何を意味するかを、名と値から見つける。注釈を読み、変え、町のファイルとして建てる。",
    "Builds a town file (.hsd) as 3D Tiles and loads them with the table that tells for each feature what was built on it and why.":
        "町のファイル(.hsd)を 3D Tiles にし、地物ごとに何がなぜ建てられたかを示す表とともに読み込む。",
}


def language():
    return "ja" if str(QgsSettings().value("locale/userLocale", "")).startswith("ja") else "en"


def say(word):
    return _JA.get(word, word) if language() == "ja" else word
