//! Messages about roofs (HSD05xx).
