//! Messages about walls, outlines and storeys (HSD04xx).
