//! The program as its users meet it: what it prints, writes, refuses and returns.

#[cfg(test)]
mod broken;
#[cfg(test)]
mod chain;
#[cfg(test)]
mod checkpoint;
#[cfg(test)]
mod colour;
#[cfg(test)]
mod converge;
#[cfg(test)]
mod data;
#[cfg(test)]
mod exact;
#[cfg(test)]
mod fit;
#[cfg(test)]
mod fixtures;
#[cfg(test)]
mod golden;
#[cfg(test)]
mod help;
#[cfg(test)]
mod instructions;
#[cfg(test)]
mod interrupt;
#[cfg(test)]
mod output;
#[cfg(test)]
mod program;
#[cfg(test)]
mod rows;
#[cfg(test)]
mod samplers;
#[cfg(test)]
mod spectra;
#[cfg(test)]
mod stopping;
