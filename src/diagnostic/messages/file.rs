//! Messages about the file as a whole (HSD00xx) and limits (HSD09xx).
