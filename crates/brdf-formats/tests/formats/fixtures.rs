//! Small sound files of every format, to read, to write and to break.

/// A MERL file of these dims and no values.
pub(crate) fn merl_header(dims: [i32; 3]) -> Vec<u8> {
    dims.iter().flat_map(|d| d.to_le_bytes()).collect()
}

/// A sound MERL file of 2 x 3 x 4 cells: plane c, cell i holds 100 c + i.
pub(crate) fn merl() -> Vec<u8> {
    let mut bytes = merl_header([2, 3, 4]);
    for channel in 0..3 {
        for cell in 0..24 {
            bytes.extend(f64::from(100 * channel + cell).to_le_bytes());
        }
    }
    bytes
}

/// A sound ASTM file of two rows; the `VARS` line is its 5th, the rows are its 7th and 8th.
pub(crate) const ASTM: &str = "LAB_NAME Cornell University\r\n\r\nSAMPLE_NAME Paper\r\nNUM_POINTS 2\r\n\
    VARS theta_i,phi_i,theta_s,phi_s,R,G,B\r\n\r\n\
    0.872665,0.000000,0.573513,0.000000,0.011364,-0.000779,0.002329\r\n\
    0.698132,0.000000,0.427512,-0.261799,0.012770,0.000718,-0.000000\r\n";

/// A sound pbrt text file; count in line 3, wavelengths in lines 5 and 6, rows in lines 8 and 9.
pub(crate) const PBRT: &str = "# Paper\n# num wls\n3\n# wls\n400 500\n600.5\n# rows\n\
    0.872665 0.000000 0.573513 0.000000 0.1 0.2 0.3\n\
    0.698132 0.000000 0.427512 -0.261799 0.4 0.5 0.6\n";

/// A field of a tensor file to be made.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) dtype: u8,
    pub(crate) shape: Vec<u64>,
    pub(crate) data: Vec<u8>,
}

pub(crate) const U8: u8 = 1;
pub(crate) const U32: u8 = 5;
pub(crate) const F32: u8 = 10;

impl Field {
    pub(crate) fn bytes(name: &'static str, data: &[u8]) -> Self {
        Self {
            name,
            dtype: U8,
            shape: vec![data.len() as u64],
            data: data.to_vec(),
        }
    }

    pub(crate) fn floats(name: &'static str, shape: &[u64], data: &[f32]) -> Self {
        Self {
            name,
            dtype: F32,
            shape: shape.to_vec(),
            data: data.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }

    /// f32 of this shape: 0, 1, 2, ...
    pub(crate) fn ramp(name: &'static str, shape: &[u64]) -> Self {
        let count = shape.iter().product::<u64>();
        let data: Vec<f32> = (0..count).map(|i| i as f32).collect();
        Self::floats(name, shape, &data)
    }
}

/// A tensor file of these fields, data aligned to 8 bytes.
pub(crate) fn tensor(fields: &[Field]) -> Vec<u8> {
    let header: usize = fields
        .iter()
        .map(|f| 13 + f.name.len() + 8 * f.shape.len())
        .sum();
    let mut offset = (18 + header).next_multiple_of(8);
    let mut head = b"tensor_file\0\x01\0".to_vec();
    let mut body = Vec::new();
    head.extend((fields.len() as u32).to_le_bytes());
    for field in fields {
        head.extend((field.name.len() as u16).to_le_bytes());
        head.extend(field.name.as_bytes());
        head.extend((field.shape.len() as u16).to_le_bytes());
        head.push(field.dtype);
        head.extend((offset as u64).to_le_bytes());
        head.extend(field.shape.iter().flat_map(|n| n.to_le_bytes()));
        body.extend(&field.data);
        body.resize(body.len().next_multiple_of(8), 0);
        offset = (18 + header).next_multiple_of(8) + body.len();
    }
    head.resize(head.len().next_multiple_of(8), 0);
    head.extend(body);
    head
}

/// The fields of a sound RGL file: 1 azimuth, 2 polar angles, grids of 2 x 2, RGB.
pub(crate) fn rgl_fields() -> Vec<Field> {
    vec![
        Field {
            name: "version",
            dtype: U32,
            shape: vec![2],
            data: vec![1, 0, 0, 0, 0, 0, 0, 0],
        },
        Field::bytes("description", b"Paper"),
        Field::floats("phi_i", &[1], &[0.0]),
        Field::floats("theta_i", &[2], &[0.0, 1.5]),
        Field::ramp("sigma", &[2, 2]),
        Field::ramp("ndf", &[2, 2]),
        Field::ramp("vndf", &[1, 2, 2, 2]),
        Field::ramp("luminance", &[1, 2, 2, 2]),
        Field::ramp("rgb", &[1, 2, 3, 2, 2]),
        Field::bytes("jacobian", &[1]),
        Field::bytes("valid", &[0b1010_0101]),
    ]
}

/// [`rgl_fields`] with five bands instead of RGB.
pub(crate) fn rgl_spectral_fields() -> Vec<Field> {
    let mut fields = rgl_fields();
    fields.retain(|f| f.name != "rgb");
    fields.push(Field::ramp("spectra", &[1, 2, 5, 2, 2]));
    let nm = [360.0, 420.0, 500.0, 700.5, 1000.0];
    fields.push(Field::floats("wavelengths", &[5], &nm));
    fields
}
