//! Lossless readers and writers of measured-reflectance files: bytes in, plain structs out.
