// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <complex>
#include <fstream>
#include <iterator>

#include "hogel/io/test_files.h"

namespace hogel::io {
namespace {

// A light field with a different value for every sample, which counts the small tiles that are read.
class CountedLightField final : public LightFieldSource {
  public:
    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    HogelRange preferred_tile() const override { return {0, 0, 2, 2}; }
    void read(LightFieldTile& tile) const override {
        ++reads;
        const HogelRange& r = tile.range;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t t = 0; t < r.nt; ++t)
                for (std::size_t s = 0; s < r.ns; ++s)
                    for (std::size_t k = 0; k < grid_.directions(); ++k) {
                        const auto value = static_cast<float>(c + 3 * (s + r.s0) + 50 * (t + r.t0)) + 0.25f * float(k);
                        (&tile.radiance(c, t, s, 0, 0))[k] = value;
                        (&tile.depth(t, s, 0, 0))[k] = -value;
                    }
    }
    mutable std::atomic<std::size_t> reads{0};

  private:
    LightFieldGrid grid_{9, 7, 1e-3, 2, 2, Perspective{0.3, 0.3}};
};

class CountedField final : public FieldSource {
  public:
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region& region, std::size_t, View<std::complex<float>, 2> out) const override {
        ++reads;
        for (std::size_t y = 0; y < region.height; ++y)
            for (std::size_t x = 0; x < region.width; ++x)
                out(y, x) = {static_cast<float>(x + region.x0), static_cast<float>(y + region.y0)};
    }
    mutable std::atomic<std::size_t> reads{0};

  private:
    FieldGrid grid_{{2100, 1100, 1e-6, 1e-6}, 633e-9};
};

class Resume : public testing::Test {
  protected:
    Resume() { fs::create_directories(directory_); }
    ~Resume() override { fs::remove_all(directory_); }

    static std::string bytes(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
    }
    std::unique_ptr<LightFieldSink> light_field(const char* name, const char* input) const {
        LightFieldFileOptions options;
        options.with_depth = true;
        options.resume = input;
        return create_front(directory_ / name, CountedLightField().grid(), options);
    }

    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_resume_" + std::to_string(::getpid()));
};

TEST_F(Resume, an_interrupted_light_field_becomes_the_same_file) {
    const CountedLightField source;
    copy(source, *light_field("whole.h5", "a"));
    const std::size_t all = source.reads;
    source.reads = 0;
    for (const double enough : {0.3, 0.6}) {
        const auto sink = light_field("x.h5", "a");
        EXPECT_THROW(copy(source, *sink, [&](double done) { return done < enough; }), Error);
        EXPECT_FALSE(fs::exists(directory_ / "x.h5"));
    }
    copy(source, *light_field("x.h5", "a"));
    EXPECT_EQ(source.reads, all) << "each tile once";
    EXPECT_TRUE(bytes(directory_ / "x.h5") == bytes(directory_ / "whole.h5"));
    EXPECT_EQ(files(), 2u) << "nothing else remains";
}

TEST_F(Resume, an_interrupted_hologram_becomes_the_same_file) {
    const CountedField source;
    const auto create = [&](const char* name) {
        return create_hologram(directory_ / name, std::vector(2, source.grid()), {.resume = "a"});
    };
    for (auto& sink : create("whole.h5")) copy(source, *sink, 0);
    const std::size_t all = source.reads;
    source.reads = 0;
    {
        const auto sinks = create("x.h5");
        copy(source, *sinks[0], 0);
        EXPECT_THROW(copy(source, *sinks[1], 0, [](double done) { return done < 0.5; }), Error);
    }
    for (auto& sink : create("x.h5")) copy(source, *sink, 0);
    EXPECT_EQ(source.reads, all);
    EXPECT_TRUE(bytes(directory_ / "x.h5") == bytes(directory_ / "whole.h5"));
}

TEST_F(Resume, other_work_is_refused_and_the_unfinished_file_stays) {
    EXPECT_THROW(copy(CountedLightField(), *light_field("x.h5", "a"), [](double done) { return done < 0.5; }), Error);
    const std::string begun = bytes(directory_ / "x.h5.part");
    EXPECT_THROW(light_field("x.h5", "b"), Error);
    EXPECT_TRUE(bytes(directory_ / "x.h5.part") == begun);
}

TEST_F(Resume, without_one_of_its_files_work_begins_again) {
    const CountedLightField source;
    copy(source, *light_field("whole.h5", "a"));
    const std::size_t all = source.reads;
    for (const char* lost : {"x.h5.part", "x.h5.part.journal"}) {
        source.reads = 0;
        EXPECT_THROW(copy(source, *light_field("x.h5", "a"), [](double done) { return done < 0.5; }), Error);
        fs::remove(directory_ / lost);
        const std::size_t before = source.reads;
        copy(source, *light_field("x.h5", "a"));
        EXPECT_EQ(source.reads - before, all) << lost;
        EXPECT_TRUE(bytes(directory_ / "x.h5") == bytes(directory_ / "whole.h5"));
    }
}

}  // namespace
}  // namespace hogel::io
