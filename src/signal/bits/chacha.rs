//! Sixteen blocks of ChaCha8 [^1] at once: the bytes that the generator gives, by vectors wider than its own.
//!
//! A block is a matrix of four rows of four words. A vector holds one row of four blocks, so that each operation
//! of the cipher is one instruction for all of them. Four times four blocks take turns, because every operation
//! waits for the one before it.
//!
//! [^1]: D. J. Bernstein, "ChaCha, a variant of Salsa20", 2008.

use crate::rng::Generator;
use std::arch::x86_64::{
    __m512i, _mm512_add_epi32, _mm512_add_epi64, _mm512_rol_epi32, _mm512_set_epi64,
    _mm512_set4_epi32, _mm512_shuffle_epi32, _mm512_shuffle_i32x4, _mm512_storeu_si512,
    _mm512_xor_si512,
};

/// Bytes of sixteen blocks.
pub const SIXTEEN: usize = 16 * BLOCK;

/// Bytes of a block.
const BLOCK: usize = 64;

/// The four rows of four blocks: constants, key, key, then the block's number and the stream.
type Four = [__m512i; 4];

/// Fills `sixteens` from block `number` of the generator's stream on.
#[target_feature(enable = "avx512f")]
pub fn fill(generator: &Generator, number: u64, sixteens: &mut [[u8; SIXTEEN]]) {
    let mut starts = starts(generator, number);
    for bytes in sixteens {
        let mut state = starts;
        for _ in 0..4 {
            for rows in &mut state {
                round(rows);
                by_diagonals(rows);
            }
            for rows in &mut state {
                round(rows);
                by_columns(rows);
            }
        }
        let (fours, _) = bytes.as_chunks_mut::<{ 4 * BLOCK }>();
        for ((bytes, state), start) in fours.iter_mut().zip(&state).zip(&mut starts) {
            write(
                std::array::from_fn(|row| _mm512_add_epi32(state[row], start[row])),
                bytes,
            );
            start[3] = _mm512_add_epi64(start[3], _mm512_set_epi64(0, 16, 0, 16, 0, 16, 0, 16));
        }
    }
}

#[target_feature(enable = "avx512f")]
fn starts(generator: &Generator, number: u64) -> [Four; 4] {
    let seed = generator.get_seed();
    let (key, _) = seed.as_chunks();
    let row = |[a, b, c, d]: [i32; 4]| _mm512_set4_epi32(d, c, b, a);
    let key = |first: usize| row(std::array::from_fn(|i| i32::from_le_bytes(key[first + i])));
    let constants = row([0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574]);
    let stream = generator.get_stream() as i64;
    std::array::from_fn(|four| {
        let at = |block: usize| number.wrapping_add((4 * four + block) as u64) as i64;
        let last = _mm512_set_epi64(stream, at(3), stream, at(2), stream, at(1), stream, at(0));
        [constants, key(0), key(4), last]
    })
}

/// The quarter round of each column.
#[inline]
#[target_feature(enable = "avx512f")]
fn round([a, b, c, d]: &mut Four) {
    mix::<16>(a, *b, d);
    mix::<12>(c, *d, b);
    mix::<8>(a, *b, d);
    mix::<7>(c, *d, b);
}

#[inline]
#[target_feature(enable = "avx512f")]
fn mix<const BITS: i32>(sum: &mut __m512i, more: __m512i, turned: &mut __m512i) {
    *sum = _mm512_add_epi32(*sum, more);
    *turned = _mm512_rol_epi32::<BITS>(_mm512_xor_si512(*turned, *sum));
}

/// Shifts the rows so that diagonals become columns.
#[inline]
#[target_feature(enable = "avx512f")]
fn by_diagonals([_, b, c, d]: &mut Four) {
    *b = _mm512_shuffle_epi32::<0b00_11_10_01>(*b);
    *c = _mm512_shuffle_epi32::<0b01_00_11_10>(*c);
    *d = _mm512_shuffle_epi32::<0b10_01_00_11>(*d);
}

/// Shifts them back.
#[inline]
#[target_feature(enable = "avx512f")]
fn by_columns([_, b, c, d]: &mut Four) {
    *b = _mm512_shuffle_epi32::<0b10_01_00_11>(*b);
    *c = _mm512_shuffle_epi32::<0b01_00_11_10>(*c);
    *d = _mm512_shuffle_epi32::<0b00_11_10_01>(*d);
}

/// Writes four blocks, one after the other: each consists of its quarters of the rows.
#[allow(
    unsafe_code,
    reason = "only stores through pointers take a whole vector"
)]
#[inline]
#[target_feature(enable = "avx512f")]
fn write([a, b, c, d]: Four, bytes: &mut [u8; 4 * BLOCK]) {
    const EVEN: i32 = 0b10_00_10_00;
    const ODD: i32 = 0b11_01_11_01;
    let even = (
        _mm512_shuffle_i32x4::<EVEN>(a, b),
        _mm512_shuffle_i32x4::<EVEN>(c, d),
    );
    let odd = (
        _mm512_shuffle_i32x4::<ODD>(a, b),
        _mm512_shuffle_i32x4::<ODD>(c, d),
    );
    let blocks = [
        _mm512_shuffle_i32x4::<EVEN>(even.0, even.1),
        _mm512_shuffle_i32x4::<EVEN>(odd.0, odd.1),
        _mm512_shuffle_i32x4::<ODD>(even.0, even.1),
        _mm512_shuffle_i32x4::<ODD>(odd.0, odd.1),
    ];
    for (bytes, block) in bytes.as_chunks_mut::<BLOCK>().0.iter_mut().zip(blocks) {
        // SAFETY: a vector has as many bytes as a block, and may be stored at any address.
        unsafe { _mm512_storeu_si512(bytes.as_mut_ptr().cast(), block) };
    }
}
