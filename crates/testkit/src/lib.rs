//! For tests only: chi-square, Z-test, fixtures.
