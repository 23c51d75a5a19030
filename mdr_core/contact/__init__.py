"""The contact at rest: the rule of yield, integrals over the live interval, states and fields."""
