//! Messages about the XML form (HSD02xx).
