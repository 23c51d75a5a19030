"""Random calls of every public function; `tests.fuzz_long` runs them."""
