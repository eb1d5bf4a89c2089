use super::*;

fn picture(of: impl Fn(u32, u32) -> [u8; 3]) -> Picture {
    let (width, height) = (8, 6);
    let rgb = (0..width * height).flat_map(|pixel| of(pixel % width, pixel / width)).collect();
    Picture { width, height, rgb }
}

#[test]
fn a_decoded_gif_shows_its_pictures_with_the_right_delays() {
    let ground = |_, row| [200, 200, if row < 3 { 250 } else { 100 }];
    let pictures = [0, 1, 1, 5]
        .map(|place| picture(|column, row| if column == place { [255, 0, 0] } else { ground(column, row) }));
    let mut bytes = Vec::new();
    let mut gif = Gif::new(&mut bytes, 30.0);
    pictures.iter().for_each(|picture| gif.add(picture).unwrap());
    drop(gif);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).unwrap();
    assert_eq!((decoder.width(), decoder.height()), (8, 6));
    let (mut shown, mut delays) = (vec![0; 8 * 6 * 3], Vec::new());
    for picture in &pictures {
        let frame = decoder.read_next_frame().unwrap().expect("one frame per picture");
        delays.push(frame.delay);
        for (index, rgba) in frame.buffer.as_chunks::<4>().0.iter().enumerate() {
            let at = (frame.top as usize * 8 + index) * 3;
            if rgba[3] != 0 {
                shown[at..at + 3].copy_from_slice(&rgba[..3]);
            }
        }
        let largest = shown.iter().zip(&picture.rgb).map(|(shown, original)| shown.abs_diff(*original)).max();
        assert!(largest <= Some(CHANGE_MAX), "colours differ by {largest:?}");
    }
    assert!(decoder.read_next_frame().unwrap().is_none());
    // A thirtieth of a second is not a whole number of hundredths; the sum of delays is right.
    assert_eq!(delays, [3, 4, 3, 3]);
}

#[test]
fn rare_colours_are_kept() {
    let arrow = [38, 178, 64];
    // Sky and ground of many greys, a robot of many browns, and one small arrow.
    let wall = |at: u32| {
        let shade = (at % 157) as u8;
        match at {
            2100..2103 => arrow,
            0..3600 => [60 + shade, 65 + shade, 75 + shade],
            _ => [shade, shade / 2, shade / 4],
        }
    };
    let picture = Picture { width: 64, height: 64, rgb: (0..64 * 64).flat_map(wall).collect() };
    let mut bytes = Vec::new();
    Gif::new(&mut bytes, 10.0).add(&picture).unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).unwrap();
    let frame = decoder.read_next_frame().unwrap().unwrap();
    let shown = &frame.buffer[4 * 2100..4 * 2100 + 3];
    assert!(shown.iter().zip(arrow).all(|(shown, part)| shown.abs_diff(part) < 12), "{shown:?}");
}

#[test]
fn small_changes_are_not_written_and_do_not_add_up() {
    let shade = |bright: u8| picture(|_, row| [if row == 0 { 200 } else { bright }; 3]);
    let shown = |brights: &[u8]| {
        let mut gif = Gif::new(Vec::new(), 10.0);
        brights.iter().for_each(|bright| gif.add(&shade(*bright)).unwrap());
        let bytes = gif.finish().unwrap();
        let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
        let mut heights = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            heights.push(frame.height);
        }
        heights
    };
    // A frame without change has one row.
    assert_eq!(shown(&[100, 100 + CHANGE_MAX - 1]), [6, 1]);
    // The palette has only the colours of the first picture, and what differs from them much.
    assert_eq!(shown(&[100, 103, 106, 190]), [6, 1, shown(&[100, 106])[1], 5]);
}

#[test]
fn pictures_of_another_size_and_huge_ones_are_refused() {
    let mut gif = Gif::new(Vec::new(), 10.0);
    gif.add(&picture(|_, _| [1, 2, 3])).unwrap();
    let other = Picture { width: 4, height: 12, ..picture(|_, _| [1, 2, 3]) };
    assert!(gif.add(&other).unwrap_err().to_string().contains("4 × 12"));
    let huge = Picture { width: 70_000, height: 1, rgb: vec![0; 210_000] };
    assert!(Gif::new(Vec::new(), 10.0).add(&huge).unwrap_err().to_string().contains("70000 × 1"));
}

#[test]
fn a_png_holds_the_exact_pixels() {
    let picture = picture(|column, row| [column as u8 * 30, row as u8 * 40, 7]);
    let bytes = png(&picture).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    assert_eq!(pixels, picture.rgb);
}
