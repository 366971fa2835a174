//! Messages about parts and operations (HSD03xx).
