//! Messages about the legacy text (HSD01xx).
