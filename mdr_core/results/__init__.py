"""Results: their quantities, limits, reports and plots."""
