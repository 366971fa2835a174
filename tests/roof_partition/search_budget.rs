//! The budget of a search: below it the best partition, beyond it the greedy one.

use hsd::geometry::plan::{Cell, Plan};
use hsd::roof::budget::SearchBudget;
use hsd::roof::partition::{Method, partition, partition_within};

/// Makes a staircase-shaped plan with the given number of steps.
fn stair(steps: i64) -> Plan {
    let step = |k: i64| [(steps - k, k + 1), (steps - k - 1, k + 1)];
    let corners = [(0, 0), (steps, 0)].into_iter();
    Plan::from_loops(vec![corners.chain((0..steps).flat_map(step)).collect()])
}

#[test]
fn what_is_left_to_search_decides_between_best_and_greedy() {
    for (method, steps) in [(Method::LeastCut, 30), (Method::BranchCut, 60)] {
        let plan = stair(steps);
        let best = partition(&plan, method);
        let plenty = SearchBudget::new(100_000_000);
        assert_eq!(partition_within(&plan, method, &plenty), best);
        assert!(!plenty.is_news());
        let spent = SearchBudget::new(0);
        let greedy = partition_within(&plan, method, &spent);
        assert_ne!(greedy, best);
        assert_eq!(greedy.iter().map(Cell::area).sum::<i128>(), plan.area());
        assert!(spent.is_news() && !spent.is_news());
        // Realistic plans are still searched.
        let (small, best) = (stair(3), partition(&stair(3), method));
        assert_eq!(partition_within(&small, method, &spent), best);
        assert!(!spent.is_news());
    }
}
