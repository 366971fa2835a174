//! Partition into roof rectangles and the ridge rules, against naive second opinions.
mod branch_cut_check;
mod kd_check;
mod least_cut_check;
mod outlines;
mod page;
mod properties;
mod search_budget;
mod shapes;
