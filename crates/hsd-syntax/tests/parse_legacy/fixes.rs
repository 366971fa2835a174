//! Slips, and how each is mended.

use super::*;

#[test]
fn slips_in_walls_are_fixed() {
    let codes = |walls: &str| rows(walls).remove(0).0;
    for (walls, meant) in [
        ("GSI　GSI　GDE 2TOD", "GSI  |GSI  |GDE 2|TOD  "),
        ("GSI\tGSI\tKKS", "GSI  |GSI  |KKS  "),
        ("ＧＳＩ　　ＫＫＳ", "GSI  |KKS  "),
        (" GSI  GSI  GDE 2TOD  KKS", "GSI  |GSI  |GDE 2|TOD  |KKS  "),
        ("       GSI  GSI", "     |GSI  |GSI  "),
        ("GSI GSI  GDE 2TOD  KKS", "GSI  |GSI  |GDE 2|TOD  |KKS  "),
        ("GSI  GSI   GDE 2TOD  KKS", "GSI  |GSI  |GDE 2|TOD  |KKS  "),
        ("GSI GSI       KKS", "GSI  |GSI  |     |KKS  "),
        ("GSI .....KKS", "GSI  |     |KKS  "),
        ("GSI  ... KKS", "GSI  |... K|KS   "),
        ("GSI  ...  KKS", "GSI  |     |KKS  "),
        ("GSI  GSI  # front", "GSI  |GSI  "),
        ("GSI  K#1  ", "GSI  |K#1  "),
        ("KSM  X", "KSM  "),
        ("APW  APW L", "APW  |APW  "),
        ("APW  APW   L", "APW  |APW  "),
        ("APW^", "APW  "),
        ("APW  L^", "APW  "),
        ("APW  Ｌ", "APW  "),
        ("APW  ＾", "APW  "),
    ] {
        assert_eq!(codes(walls), meant, "{walls}");
        let told = told(&with_walls(walls));
        let silent = walls.contains("K#1") || walls.contains("... K");
        assert_eq!(told.is_empty(), silent, "{walls}: {told:?}");
    }
    assert_eq!(rows("APW  APW L")[0].1, Some(-90.0));
    assert_eq!(rows("APW  Ｌ")[0].1, Some(-90.0));
    assert_eq!(rows("APW  l")[0].1, Some(-90.0));
}

#[test]
fn one_slip_makes_one_message() {
    for (walls, code, place) in [
        ("GSI　GSI", 120, "　"),
        ("GSI\tGSI", 121, "\t"),
        ("APW  Ｌ", 122, "Ｌ"),
        ("KSM町 KSM", 124, "町"),
        (" GSI  GSI  GDE 2TOD", 131, " "),
        ("GSI GSI  GDE 2TOD  KKS", 132, "GSI  GDE 2TOD  KKS"),
        ("GKO  ANO ANO  ANO  AKI  TTB", 132, "ANO  ANO  AKI  TTB"),
        ("GKO, ANO, TTB", 132, "GKO, ANO, TTB"),
        ("GKO,ANO,TTB", 132, "ANO,TTB"),
        ("KSM       ", 133, "     "),
        ("KSM  X", 126, "X"),
        ("APW  APW L", 127, "L"),
        ("APW  l", 128, "l"),
        ("APW   ^\nAPW", 127, "^"),
        ("APW  L APW", 138, "L"),
        ("APW\nL APW", 138, "L"),
        ("APW  L  ", 129, "  "),
        ("KSM\nAPW  ^KSM", 130, "KSM"),
        ("KSM  # x", 113, "# x"),
        ("KSM  # 壁", 113, "# 壁"),
        ("  # x\nKSM", 113, "# x"),
        ("KSM  ^", 135, "^"),
        ("KSM\n\nKSM", 125, "\n"),
    ] {
        assert_eq!(pointed(&with_walls(walls)), [(code, place)], "{walls:?}");
    }
}

#[test]
fn roofs_are_fixed_field_by_field() {
    for (roof, expected) in [
        ("K X * KIR 0 0 2 2", vec![]),
        ("* * * * 0 0 2 2.5", vec![]),
        ("K\tX\u{3000}* KIR 0 0 2 2 O", vec![]),
        ("Q X * KIR 0 0 2 2", vec![(140, "Q")]),
        ("K X * KRI 0 0 2 2 P4,0", vec![(142, "KRI"), (103, "P4,0")]),
        ("KX 14.0 KIR 0 0 6 8", vec![(148, "KX")]),
        ("K 14.0 KIR 0 0 6 8", vec![(145, "")]),
        ("K X KIR 0 0 6 8", vec![(145, "")]),
        ("K X 14 0 0 6 8", vec![(145, "")]),
        ("K X * HSI 0 0 6 8", vec![(142, "HSI")]),
        ("K F * 庇 0 0 6 8", vec![(142, "庇")]),
        ("瓦 X * KIR 0 0 6 8", vec![(140, "瓦")]),
        ("K X * KIR 0 0 6", vec![(146, "")]),
        ("K X * KIR 0 0 6 P4 E2", vec![(146, "")]),
        ("K X * KIR 3 0 3 8", vec![(147, "3")]),
        ("K L * KIR 0 0 6 8", vec![(144, "L")]),
        ("K X * KAT 0 0 6 8", vec![(144, "X")]),
        ("K X * KIR 0 0 6 8 9", vec![(107, "9")]),
        ("K X * KIR 0 0 6 8 P40", vec![(104, "P40")]),
        ("K X * KIR 0 0 6 8 P4 P5", vec![(108, "P5")]),
        ("K X * KIR 0 0 6 8 P 4.0", vec![(150, "P")]),
        ("K X * KIR 0 0 6 8 M2.5", vec![(151, "M2.5")]),
        ("k x * KIR 0 0 6 8 p4", vec![(149, "k x * KIR 0 0 6 8 p4")]),
        ("K X * KIR 0 0 6 8 # main", vec![(113, "# main")]),
        ("K X Ｋ KIR 0 0 6 8", vec![(103, "Ｋ"), (122, "Ｋ")]),
    ] {
        let text = with_roof(roof);
        assert_eq!(pointed(&text), expected, "{roof}");
        let lines = house(&text).roofs.lines.clone();
        let lost = expected
            .iter()
            .any(|(code, _)| matches!(code, 142 | 146 | 147));
        assert_eq!(lines.len(), usize::from(!lost), "{roof}");
    }
}

#[test]
fn headers_are_fixed_word_by_word() {
    let with = |header: &str| format!("{header}\n\nKSM\n");
    for (header, expected) in [
        ("0", vec![102]),
        ("0, 0", vec![103]),
        ("０ 0", vec![122]),
        ("0 1e999", vec![103]),
        ("0 0 180 5", vec![107]),
        ("0 0\n9 0", vec![104, 112]),
        ("0 0\n9\n9", vec![111]),
        ("0 0\nUnit 3.25", vec![105]),
        ("0 0\nunit: 3.25", vec![105]),
        ("0 0\nunit=3.25", vec![105]),
        ("0 0\nunit 0", vec![104]),
        ("0 0\nunit", vec![117]),
        ("0 0\nname", vec![117]),
        ("0 0\nseed 1.5", vec![118]),
        ("0 0\nseed x", vec![103]),
        ("0 0\nroofs autos", vec![106]),
        ("町家\n0 0", vec![105]),
    ] {
        let found: Vec<u16> = told(&with(header));
        assert_eq!(found, expected, "{header}");
    }
    let unit = house(&with("0 0\nunit=3.25")).settings.unit;
    assert_eq!(unit.map(|u| u.value), Some(3.25));
    let roofs = house(&with("0 0\nroofs Explicit")).roofs;
    assert_eq!(roofs.mode.map(|m| m.value), Some(RoofMode::Explicit));
    let heights = house("0 0\n0 5\n\nKSM\nKSM  ^\nKSM\n").heights;
    assert_eq!(
        heights.iter().map(|h| h.value).collect::<Vec<_>>(),
        [9.0, 5.0]
    );
}

#[test]
fn heights_left_out_or_in_another_unit_are_told() {
    let with = |header: &str| format!("{header}\n\nKSM\nKSM  ^\nKSM\n");
    for (header, expected) in [
        ("9.5 8", vec![(119, "9.5 8")]),
        ("0", vec![(102, "")]),
        ("0 0\n9", vec![]),
        ("0 0\n9 4", vec![]),
        ("0 0\n2.9 3.9", vec![(137, "2.9"), (137, "3.9")]),
        ("0 0\n95 40", vec![(137, "95")]),
    ] {
        assert_eq!(all_told(&with(header)), expected, "{header}");
    }
    assert_eq!(all_told("KSM\n"), [(101, "")]);
}

#[test]
fn what_belongs_to_other_languages_is_told_once() {
    // What stands after the first tag is read, so that its faults are told as well.
    let told = all_told("# x\n<House>\n<Row/>\n</House>\n");
    assert_eq!(told, [(139, "<House>"), (223, "Row")]);
    assert_eq!(
        all_told("0 0\n<House></House>\n"),
        [(139, "<House></House>")]
    );
    for sign in ["//", ";"] {
        let text = format!("{sign} front\n0 0\n9\n\nKSM\n{sign} 壁\nKSM\n");
        assert_eq!(all_told(&text), [(113, sign), (113, sign)]);
    }
}
