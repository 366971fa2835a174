//! How far a run of many pictures has come.

use hsd_base::diagnostic::Text;
use hsd_base::text;
use std::path::Path;
use std::time::Instant;

/// How far a run has come.
pub(super) struct Progress {
    begun: Instant,
    pub(super) done: usize,
    pub(super) total: usize,
}

impl Progress {
    pub(super) fn new(total: usize) -> Progress {
        Progress {
            begun: Instant::now(),
            done: 0,
            total,
        }
    }

    /// Tells that a picture is written; of many also how many there are, and how long the others will take.
    pub(super) fn message(&self, path: &Path) -> Text {
        let (path, elapsed) = (path.display(), self.begun.elapsed());
        let (done, total, ms) = (self.done, self.total, elapsed.as_millis());
        if total == 1 {
            return text!([path, ms] "wrote {path} in {ms} ms", "{path} を書きました ({ms} ms)");
        }
        let left = (total - done.min(total)) as f64 * elapsed.as_secs_f64() / done.max(1) as f64;
        let left = left.ceil();
        match done < total {
            true => text!([path, done, total, left]
                "wrote {path} ({done} of {total}, about {left} s left)",
                "{path} を書きました ({done}/{total}、残り約 {left} 秒)"
            ),
            false => text!([path, total, ms]
                "wrote {path} ({total} of {total}, {ms} ms in all)",
                "{path} を書きました ({total}/{total}、合計 {ms} ms)"
            ),
        }
    }
}
