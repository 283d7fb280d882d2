//! Links Embree where the feature asks for it.

fn main() {
    if std::env::var_os("CARGO_FEATURE_EMBREE").is_some() {
        println!("cargo:rustc-link-lib=embree3");
    }
}
