//! `gonio measure MODEL -o OUT`: a virtual gonioreflectometer.
