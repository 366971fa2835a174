//! House files out of images: [`plan`] reads drawn floor plans, [`front`] reads photographs of facades.

pub mod front;
pub mod messages;
pub mod plan;
