// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/measure.h"
#include "bench/peers/coders.h"
#include "bench/session.h"

namespace hogel::bench {
namespace {

// Levels of OpenEXR's lossy compression, the best first; 45 is its default.
constexpr std::array levels{2, 10, 45, 200, 1000, 5000, 20000, 100000};

constexpr int channels = 2;
constexpr const char* file_name = "a.exr";  // the file is kept in memory

// All hogels side by side as one picture of floats. Its channel has a name that OpenEXR codes lossily. With a single
// channel OpenImageIO would not do so; therefore there is a second one of zeros, which takes hardly any bytes.
class Sheet {
  public:
    explicit Sheet(const LightFieldBuffer& field)
        : spec_(static_cast<int>(field.grid().hogels_s * field.grid().directions_u),
                static_cast<int>(field.grid().hogels_t * field.grid().directions_v), channels, OIIO::TypeDesc::FLOAT) {
        spec_.channelnames = {"Y", "A"};
        const LightFieldGrid& grid = field.grid();
        for (std::size_t t = 0; t < grid.hogels_t; ++t)
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t s = 0; s < grid.hogels_s; ++s)
                    for (const float value : field.radiance[0][t][s][v].elements()) {
                        samples_.push_back(value);
                        samples_.push_back(0);
                    }
    }
    // The compressed bytes; nothing if this OpenEXR lacks the compression.
    std::optional<std::vector<unsigned char>> coded(const std::string& compression) const {
        OIIO::ImageSpec spec = spec_;
        spec["compression"] = compression;
        std::vector<unsigned char> bytes;
        OIIO::Filesystem::IOVecOutput into(bytes);
        const auto output = OIIO::ImageOutput::create(file_name, &into);
        if (!output || !output->open(file_name, spec) || !output->write_image(OIIO::TypeDesc::FLOAT, samples_.data()) ||
            !output->close())
            return std::nullopt;
        return bytes;
    }
    std::optional<std::vector<float>> decoded(const std::vector<unsigned char>& bytes) const {
        OIIO::Filesystem::IOMemReader from(bytes.data(), bytes.size());
        const auto input = OIIO::ImageInput::open(file_name, nullptr, &from);
        std::vector<float> samples(samples_.size());
        if (!input || input->spec().image_pixels() * channels != samples.size() ||
            !input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, samples.data()))
            return std::nullopt;
        return samples;
    }
    const std::vector<float>& samples() const { return samples_; }

  private:
    OIIO::ImageSpec spec_;
    std::vector<float> samples_;
};

}  // namespace

std::optional<RateCurve> measure_openexr(const LightFieldBuffer& field, const std::string& compression,
                                         const QualityRange& range) {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    const Sheet sheet(field);
    const double samples = field.grid().samples();
    double signal = 0;
    for (const float value : sheet.samples()) signal += static_cast<double>(value) * value;
    RateCurve curve{"OpenEXR " + compression, {}};
    for (const int level : levels) {
        stop_if_interrupted();
        const double began = processor_seconds();
        const auto bytes = sheet.coded(fmt::format("{}:{}", compression, level));
        const double between = processor_seconds();
        const auto back = bytes ? sheet.decoded(*bytes) : std::nullopt;
        const double ended = processor_seconds();
        if (!back) return std::nullopt;
        double error = 0;
        for (std::size_t i = 0; i < back->size(); ++i) error += std::pow(double(sheet.samples()[i]) - (*back)[i], 2);
        const double sqnr = 10 * std::log10(signal / error);
        curve.points.push_back({samples / (8 * static_cast<double>(bytes->size())), sqnr,
                                1e-6 * samples / (between - began), 1e-6 * samples / (ended - between)});
        if (sqnr < range.low) break;
    }
    return curve;
}

}  // namespace hogel::bench
