//! Messages about pictures and textures (HSD06xx).
