// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/measure.h"
#include "bench/peers/coders.h"
#include "bench/session.h"
#include "hogel/image/formats/exr_memory.h"

namespace hogel::bench {
namespace {

// Levels of OpenEXR's lossy compression, the best first; 45 is its default.
constexpr std::array levels{2, 10, 45, 200, 1000, 5000, 20000, 100000};

// All hogels side by side as one picture of floats. Its channel has a name that OpenEXR codes lossily. A second
// channel, of zeros, takes hardly any bytes; the figures in the documentation were measured with it.
class Sheet {
  public:
    explicit Sheet(const LightFieldBuffer& field)
        : width_(field.grid().hogels_s * field.grid().directions_u),
          height_(field.grid().hogels_t * field.grid().directions_v) {
        const LightFieldGrid& grid = field.grid();
        for (std::size_t t = 0; t < grid.hogels_t; ++t)
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t s = 0; s < grid.hogels_s; ++s)
                    for (const float value : field.radiance[0][t][s][v].elements()) {
                        samples_.push_back(value);
                        samples_.push_back(0);
                    }
    }
    std::vector<unsigned char> coded(Imf::Compression compression, int level) const {
        Imf::Header header(static_cast<int>(width_), static_cast<int>(height_));
        header.compression() = compression;
        header.dwaCompressionLevel() = static_cast<float>(level);
        for (const char* channel : channels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        image::ExrSink sink;
        {
            Imf::OutputFile out(sink, header, threads);
            std::vector<float> copy = samples_;  // OpenEXR takes a pointer through which it could write
            out.setFrameBuffer(buffer(copy));
            out.writePixels(static_cast<int>(height_));
        }
        return std::move(sink.bytes);
    }
    std::vector<float> decoded(const std::vector<unsigned char>& bytes) const {
        image::ExrSource source(bytes, "a.exr");
        Imf::InputFile in(source, threads);
        std::vector<float> samples(samples_.size());
        in.setFrameBuffer(buffer(samples));
        in.readPixels(0, static_cast<int>(height_) - 1);
        return samples;
    }
    const std::vector<float>& samples() const { return samples_; }

  private:
    static constexpr std::array channels{"Y", "A"};
    static constexpr int threads = 0;

    Imf::FrameBuffer buffer(std::vector<float>& samples) const {
        constexpr std::size_t step = channels.size() * sizeof(float);
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < channels.size(); ++c)
            buffer.insert(channels[c],
                          Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(samples.data() + c), step, step * width_));
        return buffer;
    }

    std::size_t width_, height_;
    std::vector<float> samples_;
};

}  // namespace

std::optional<RateCurve> measure_openexr(const LightFieldBuffer& field, const std::string& compression,
                                         const QualityRange& range) {
    if (compression != "dwaa" && compression != "dwab") return std::nullopt;
    const Imf::Compression method = compression == "dwaa" ? Imf::DWAA_COMPRESSION : Imf::DWAB_COMPRESSION;
    const Sheet sheet(field);
    const double samples = field.grid().samples();
    double signal = 0;
    for (const float value : sheet.samples()) signal += static_cast<double>(value) * value;
    RateCurve curve{"OpenEXR " + compression, {}};
    for (const int level : levels) {
        stop_if_interrupted();
        const double began = processor_seconds();
        const std::vector<unsigned char> bytes = sheet.coded(method, level);
        const double between = processor_seconds();
        const std::vector<float> back = sheet.decoded(bytes);
        const double ended = processor_seconds();
        double error = 0;
        for (std::size_t i = 0; i < back.size(); ++i) error += std::pow(double(sheet.samples()[i]) - back[i], 2);
        const double sqnr = 10 * std::log10(signal / error);
        curve.points.push_back({samples / (8 * static_cast<double>(bytes.size())), sqnr,
                                1e-6 * samples / (between - began), 1e-6 * samples / (ended - between)});
        if (sqnr < range.low) break;
    }
    return curve;
}

}  // namespace hogel::bench
