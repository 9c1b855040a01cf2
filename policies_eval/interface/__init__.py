"""What a suite's actions and observations mean, as data, and whether a policy keeps to it."""
