//! Published numbers.

use spectrum::ciede2000;

#[test]
fn ciede2000_gives_sharmas_34_pairs() {
    let csv = include_str!("reference/ciede2000_sharma2005.csv");
    let mut pairs = 0;
    for line in csv.lines().filter(|l| !l.starts_with('#')) {
        let v: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        let (first, second) = ([v[0], v[1], v[2]], [v[3], v[4], v[5]]);
        // the table has four decimals
        let (forth, back) = (ciede2000(first, second), ciede2000(second, first));
        assert!((forth - v[6]).abs() <= 5.001e-5, "{line}: {forth}");
        assert!((back - v[6]).abs() <= 5.001e-5, "{line}, exchanged: {back}");
        pairs += 1;
    }
    assert_eq!(pairs, 34);
}

#[test]
fn equal_colours_do_not_differ() {
    for lab in [[0.0; 3], [50.0, 0.0, 0.0], [70.0, -30.0, 12.0]] {
        assert!(ciede2000(lab, lab).abs() < 1e-12);
    }
}
