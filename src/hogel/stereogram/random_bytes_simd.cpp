// SPDX-License-Identifier: Apache-2.0
// Vector version of random_bytes_plain, compiled for every SIMD target. The first call selects the target.
#include "hogel/core/simd_targets-inl.h"
#include "hogel/stereogram/philox_lanes.h"
#include "hogel/stereogram/random_bytes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::stereogram::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void RandomBytes(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes) {
    random_bytes_plain(series, first_draw, bytes);
}
#else
// One draw per lane of 64 bits.
void RandomBytes(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes) {
    const hn::ScalableTag<std::uint64_t> d;
    const std::size_t lanes = hn::Lanes(d), at_once = 16 * lanes;
    const auto low = hn::Set(d, 0xffffffffu);
    std::size_t offset = 0;
    for (; offset + at_once <= bytes.size(); offset += at_once) {
        auto c0 = hn::Iota(d, first_draw + offset / 16), c1 = hn::Set(d, series.position[0]);
        auto c2 = hn::Set(d, series.position[1]), c3 = hn::Set(d, series.position[2]);
        philox_lanes(d, c0, c1, c2, c3, series.key);
        const auto first = hn::Or(hn::And(c0, low), hn::ShiftLeft<32>(c1));
        const auto second = hn::Or(hn::And(c2, low), hn::ShiftLeft<32>(c3));
        hn::StoreInterleaved2(first, second, d, reinterpret_cast<std::uint64_t*>(bytes.data() + offset));
    }
    if (offset < bytes.size())
        random_bytes_plain(series, first_draw + static_cast<std::uint32_t>(offset / 16), bytes.subspan(offset));
}
#endif

}  // namespace hogel::stereogram::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::stereogram {
HOGEL_DISPATCH(random_bytes, RandomBytes);
}  // namespace hogel::stereogram
