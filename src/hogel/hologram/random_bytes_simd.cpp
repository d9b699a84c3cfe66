// The vector twin of random_bytes_plain, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/hologram/random_bytes_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "hogel/hologram/random_bytes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void RandomBytes(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes) {
    random_bytes_plain(series, first_draw, bytes);
}
#else
// One draw a lane of 64 bits. Of each word of the counter the lower half counts; the upper half may hold anything,
// because the products are of lower halves alone.
void RandomBytes(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes) {
    const hn::ScalableTag<std::uint64_t> d;
    const hn::Repartition<std::uint32_t, decltype(d)> halves;
    const std::size_t lanes = hn::Lanes(d), at_once = 16 * lanes;
    const auto times = [&](auto value, auto factor) {
        return hn::MulEven(hn::BitCast(halves, value), hn::BitCast(halves, factor));
    };
    const auto a = hn::Set(d, 0xD2511F53u), b = hn::Set(d, 0xCD9E8D57u), low = hn::Set(d, 0xffffffffu);
    std::size_t done = 0;
    for (; done + at_once <= bytes.size(); done += at_once) {
        auto c0 = hn::Iota(d, first_draw + done / 16), c1 = hn::Set(d, series.position[0]);
        auto c2 = hn::Set(d, series.position[1]), c3 = hn::Set(d, series.position[2]);
        std::uint32_t k0 = series.key[0], k1 = series.key[1];
        for (int round = 0; round < 10; ++round, k0 += 0x9E3779B9u, k1 += 0xBB67AE85u) {
            const auto p = times(c0, a), q = times(c2, b);
            c0 = hn::Xor(hn::Xor(hn::ShiftRight<32>(q), c1), hn::Set(d, k0));
            c2 = hn::Xor(hn::Xor(hn::ShiftRight<32>(p), c3), hn::Set(d, k1));
            c1 = q;
            c3 = p;
        }
        const auto first = hn::Or(hn::And(c0, low), hn::ShiftLeft<32>(c1));
        const auto second = hn::Or(hn::And(c2, low), hn::ShiftLeft<32>(c3));
        hn::StoreInterleaved2(first, second, d, reinterpret_cast<std::uint64_t*>(bytes.data() + done));
    }
    if (done < bytes.size())
        random_bytes_plain(series, first_draw + static_cast<std::uint32_t>(done / 16), bytes.subspan(done));
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(RandomBytes);

void random_bytes(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes) {
    HWY_DYNAMIC_DISPATCH(RandomBytes)(series, first_draw, bytes);
}

}  // namespace hogel
#endif
