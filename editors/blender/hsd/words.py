# SPDX-License-Identifier: GPL-3.0-or-later
"""The words of the add-on in Japanese."""

_JA = {
    "Import House Text": "家のテキストを読み込む",
    "House Text (.hsd)": "家のテキスト (.hsd)",
    "House Text": "家のテキスト",
    "Select a house, or import one": "家を選ぶか、読み込んでください",
    "Reload": "読み直す",
    "Reload on Save": "保存時に読み直す",
    "Values of the Text": "テキストの値に戻す",
    "Detail": "詳細度",
    "0 Walls and roofs": "0 壁と屋根",
    "1 Pictures of parts": "1 部材の画像",
    "2 Openings": "2 開口部",
    "3 Everything": "3 すべて",
    "Without Roofs": "屋根なし",
    "Up to Storey": "この階まで",
    "Seed": "乱数の種",
    "Tiles": "タイル",
    "Towns as Tiles": "町をタイルにする",
    "Folder": "フォルダー",
    "Table of Decisions": "判断の表",
    "Messages": "指摘",
    "Parameters": "パラメーター",
    "This Object": "このオブジェクト",
    "Go to Line": "行へ移動",
    "Go to Place": "その場所へ移動",
    "Select What This Line Makes": "この行が作るものを選択",
    "Set": "指定する",
    "Program": "プログラム",
    "Editor": "エディター",
}
CONTEXTS = ("*", "Operator")
TRANSLATIONS = {"ja_JP": {(context, word): japanese for word, japanese in _JA.items() for context in CONTEXTS}}
