//! What is said of photographs: refusals.

use hsd_base::diagnostic::Diagnostic;
use hsd_base::source::{Source, Span};
use hsd_front::messages as say;
use hsd_front::wall::Lost;
use hsd_front::{MOST_CELLS, Refused};
use hsd_trace::plan::Unreadable;

/// Says why there is no front; `sources` are the photographs.
pub(crate) fn refused(sources: &[Source], why: Refused) -> Diagnostic {
    match why {
        Refused::Lost(photo, lost) => {
            let span = sources[photo].span(0..0);
            match lost {
                Lost::Edges(edges) => say::few_edges(span, edges),
                Lost::Meeting => say::no_meeting(span),
                Lost::Sides(share) => say::no_sides(span, share),
            }
        }
        Refused::Lattice => say::lattice(sources[0].span(0..0), MOST_CELLS),
    }
}

/// Says that a photograph cannot be read; `span` is the photograph.
pub(crate) fn unreadable(span: Span, why: &Unreadable) -> Diagnostic {
    match why {
        Unreadable::Format => say::no_picture(span),
        Unreadable::TooLarge => say::too_large(span),
        Unreadable::Damaged(why) => say::damaged(span, why),
    }
}
