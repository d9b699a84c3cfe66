// SPDX-License-Identifier: Apache-2.0
// Vector version of add_wave_plain, compiled for every SIMD target. The first call selects the target.
#include <numbers>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/direct/exact_sums.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::direct::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void AddWave(const ScenePoint& point, const FieldGrid& grid, const SampleRow& row, const bool* hidden, double* real,
             double* imaginary) {
    add_wave_plain(point, grid, row, hidden, real, imaginary);
}
#else
using D = hn::CappedTag<double, tile_side>;
using V = hn::Vec<D>;

// Sine and cosine by power series, for angles up to an eighth of a cycle.
HWY_INLINE V Sine(D d, V angle, V square) {
    V sum = hn::Set(d, 1.0 / 6227020800);
    for (const double term : {-1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6})
        sum = hn::MulAdd(sum, square, hn::Set(d, term));
    return hn::MulAdd(hn::Mul(sum, square), angle, angle);
}
HWY_INLINE V Cosine(D d, V square) {
    V sum = hn::Set(d, -1.0 / 87178291200);
    for (const double term : {1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -0.5, 1.0})
        sum = hn::MulAdd(sum, square, hn::Set(d, term));
    return sum;
}

void AddWave(const ScenePoint& point, const FieldGrid& grid, const SampleRow& row, const bool* hidden, double* real,
             double* imaginary) {
    const D d;
    // Light travels to the sample from a point behind the hologram, and to a point in front of it.
    const double sign = point.position.z < 0 ? 1 : -1;
    const double dy = row.y - point.position.y, dz = -point.position.z;
    const V square_yz = hn::Set(d, dy * dy + dz * dz);
    const bool isotropic = point.normal == Vec3{};
    for (std::size_t i = 0; i < tile_side; i += hn::Lanes(d)) {
        const V index = hn::Add(hn::Iota(d, 0), hn::Set(d, static_cast<double>(i)));
        const V dx = hn::MulAdd(index, hn::Set(d, row.pitch), hn::Set(d, row.x - point.position.x));
        const V distance = hn::Sqrt(hn::MulAdd(dx, dx, square_yz));
        const V inverse = hn::Div(hn::Set(d, 1.0), distance);
        // Samples with |sin| ≤ λ/2Δ in x and in y.
        const auto active = hn::And(
            hn::Le(hn::Mul(hn::Abs(dx), hn::Set(d, 2 * grid.plane.pitch_x)),
                   hn::Mul(distance, hn::Set(d, grid.wavelength))),
            hn::Le(hn::Set(d, std::abs(dy) * 2 * grid.plane.pitch_y), hn::Mul(distance, hn::Set(d, grid.wavelength))));
        if (hn::AllFalse(d, active)) continue;
        V modulus = hn::Mul(hn::Set(d, static_cast<double>(point.amplitude)), inverse);
        if (!isotropic) {
            const V projection =
                hn::MulAdd(dx, hn::Set(d, point.normal.x), hn::Set(d, dy * point.normal.y + dz * point.normal.z));
            modulus = hn::Mul(modulus, hn::Sqrt(hn::Mul(hn::Abs(projection), inverse)));
        }
        modulus = hn::IfThenElseZero(active, modulus);
        if (hidden) {
            HWY_ALIGN double visible[tile_side];
            for (std::size_t j = 0; j < hn::Lanes(d); ++j) visible[j] = hidden[i + j] ? 0 : 1;
            modulus = hn::Mul(modulus, hn::Load(d, visible));
        }
        const V phase = hn::MulAdd(distance, hn::Set(d, sign / grid.wavelength), hn::Set(d, point.cycles));
        const V cycles = hn::Sub(phase, hn::Round(phase));
        const V quarters = hn::Round(hn::Mul(cycles, hn::Set(d, 4.0)));
        const V angle = hn::Mul(hn::NegMulAdd(quarters, hn::Set(d, 0.25), cycles), hn::Set(d, 2 * std::numbers::pi));
        const V square = hn::Mul(angle, angle);
        const V sine = hn::Mul(modulus, Sine(d, angle, square)), cosine = hn::Mul(modulus, Cosine(d, square));
        // Rotates by −2 to 2 quarter cycles: an even number changes both signs or none, an odd one swaps the parts.
        const V size = hn::Abs(quarters), even = hn::Sub(hn::Set(d, 1.0), size);
        const auto odd = hn::Eq(size, hn::Set(d, 1.0));
        const V re = hn::IfThenElse(odd, hn::Neg(hn::Mul(quarters, sine)), hn::Mul(even, cosine));
        const V im = hn::IfThenElse(odd, hn::Mul(quarters, cosine), hn::Mul(even, sine));
        hn::StoreU(hn::Add(hn::LoadU(d, real + i), re), d, real + i);
        hn::StoreU(hn::Add(hn::LoadU(d, imaginary + i), im), d, imaginary + i);
    }
}
#endif

}  // namespace hogel::direct::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::direct {
HOGEL_DISPATCH(add_wave, AddWave);
}  // namespace hogel::direct
