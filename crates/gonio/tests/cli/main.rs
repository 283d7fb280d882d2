//! The program as its users meet it: what it prints, writes, refuses and returns.

mod broken;
mod chain;
mod data;
mod exact;
mod fixtures;
mod golden;
mod help;
mod interrupt;
mod output;
mod program;
