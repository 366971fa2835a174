//! Messages about rooms (HSD0440 to 0446 and 0452).

use glam::DVec2;
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// A room, by its name where it has one.
fn room(name: Option<&str>) -> Text {
    match name {
        Some(name) => {
            let name = quote(name);
            text!([name] "{name}", "{name}")
        }
        None => text!("this room", "この部屋"),
    }
}

/// Rooms of a storey whose walls do not close.
#[cold]
pub(crate) fn not_closed(first: Span) -> Diagnostic {
    let message = text!(
        "the walls of this storey do not close, so it has no rooms",
        "この階の壁が閉じていないため、部屋を作れません"
    );
    Diagnostic::warning(440, first, message)
        .help(text!("mend the walls first", "先に壁を直してください"))
}

/// A place of a room that is not between walls.
#[cold]
pub(crate) fn outside(at: Span, [low, high]: [DVec2; 2]) -> Diagnostic {
    let message = text!(
        "this place is outside of the storey's walls",
        "この位置は階の壁の外です"
    );
    let [a, b, c, d] = [low.x, high.x, low.y, high.y].map(|n| (n * 100.0).round() / 100.0);
    Diagnostic::warning(440, at, message).help(text!([a, b, c, d]
        "`at` counts units to the left of the house's origin, then units back: the walls stand between {a} and {b}, and between {c} and {d}; courtyards are outside too",
        "`at` は原点から左へのユニット数、奥へのユニット数です。壁は左へ {a} から {b}、奥へ {c} から {d} の範囲にあります。中庭も外です"
    ))
}

/// A place of a room on the line of a wall.
#[cold]
pub(crate) fn on_a_wall(at: Span) -> Diagnostic {
    let message = text!(
        "a wall stands at this place, so it is in no room",
        "この位置には壁があり、どの部屋にも入りません"
    );
    Diagnostic::warning(441, at, message).help(text!(
        "move it to the middle of the room, such as by half a unit",
        "半ユニットほどずらし、部屋の中ほどに置いてください"
    ))
}

/// Two rooms without a wall between them.
#[cold]
pub(crate) fn one_area(second: Span, first: Span, names: [Option<&str>; 2]) -> Diagnostic {
    let [one, two] = names.map(room);
    let message = text!([one, two]
        "no wall divides {two} from {one}: they are one area",
        "{one}と{two}の間に壁がなく、ひとつの範囲になっています"
    );
    Diagnostic::warning(442, second, message)
        .help(text!(
            "write the wall between them, from wall to wall: `<Loop inner=\"yes\" start=\"...\"><Row>...</Row></Loop>`; an opening in it may be a void",
            "間の壁を、壁から壁まで `<Loop inner=\"yes\" start=\"...\"><Row>...</Row></Loop>` と書いてください。開口は空白のコードでかまいません"
        ))
        .label(first, text!("the other room", "もうひとつの部屋"))
}

/// A room that no door leads into.
#[cold]
pub(crate) fn no_way_in(span: Span, name: Option<&str>) -> Diagnostic {
    let room = room(name);
    let message = text!([room]
        "nobody can enter {room}: no door or open bay leads there from outside",
        "{room}に入れません。外から通じる戸や開口がありません"
    );
    Diagnostic::warning(443, span, message).help(text!(
        "put a sliding door, a door or a void into one of its walls, and into those on the way",
        "この部屋の壁と、そこまでの壁に、引戸、戸、または空白のコードを入れてください"
    ))
}

/// A name that says another number of mats than lie in the room.
#[cold]
pub(crate) fn other_count(name: Span, called: f64, laid: f64) -> Diagnostic {
    let message = text!([called, laid]
        "a room of {called} mats by its name, but {laid} lie in it",
        "名は{called}畳ですが、敷けるのは{laid}畳です"
    );
    Diagnostic::warning(444, name, message).help(text!(
        "a mat is 2 units long and 1 wide: check the walls of the room, or its name",
        "畳は長さ 2 ユニット、幅 1 ユニットです。部屋の壁か名を確かめてください"
    ))
}

/// More walls than are divided into rooms.
#[cold]
pub(crate) fn too_many_walls(room: Span, most: usize) -> Diagnostic {
    let message = text!([most]
        "the walls of this storey have more than {most} pieces between the points where they meet, too many to work out rooms",
        "この階の壁は、交わる点で分けると{most}枚を超えるため、部屋を割り出せません"
    );
    Diagnostic::warning(445, room, message).help(text!(
        "write parts that stand in line as one row, or divide the house",
        "一直線に並ぶ部材をひとつの行に書くか、建物を分けてください"
    ))
}

/// A room that is too large for mats.
#[cold]
pub(crate) fn too_large_for_mats(room: Span, most: usize) -> Diagnostic {
    let message = text!([most]
        "this room is too large for mats: at most {most} are laid, so it has boards",
        "畳を敷くには広すぎます。敷けるのは{most}畳までのため、板の間にします"
    );
    Diagnostic::warning(446, room, message).help(text!(
        "check its walls; lengths are in units of 3 shaku",
        "壁を確かめてください。長さは 3 尺のユニットで数えます"
    ))
}

/// Rooms of an upper storey without stairs.
#[cold]
pub(crate) fn no_stairs(first: Span, storey: u32) -> Diagnostic {
    let below = storey - 1;
    let message = text!([storey]
        "no stairs lead up to storey {storey}, so nobody can enter its rooms",
        "{storey}階へ上がる階段がなく、部屋に入れません"
    );
    Diagnostic::warning(452, first, message).help(text!([below]
        "write stairs into storey {below}: `<Fixture kind=\"stairs\" at=\"...\"/>`",
        "{below}階に階段を `<Fixture kind=\"stairs\" at=\"...\"/>` と書いてください"
    ))
}
