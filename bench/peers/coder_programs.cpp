// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>

#include "bench/peers/coders.h"
#include "bench/session.h"
#include "bench/temporary_folder.h"

namespace hogel::bench {
namespace {

// Coder of ffmpeg. {} in `encoder` is replaced by one of the qualities, sorted from the best.
struct FfmpegCoder {
    const char *name, *needs, *encoder, *file;
    std::vector<double> qualities;
    bool video;
};

const std::vector<FfmpegCoder>& ffmpeg_coders() {
    static const std::vector<FfmpegCoder> all{
        {"x265",
         "libx265",
         "-c:v libx265 -preset slow -crf {} -x265-params log-level=none:pools=none:frame-threads=1",
         "a.hevc",
         {4, 10, 16, 22, 28, 34, 40, 46},
         true},
        {"svt-av1",
         "libsvtav1",
         "-c:v libsvtav1 -preset 4 -crf {} -svtav1-params lp=1",
         "a.obu",
         {4, 10, 18, 26, 34, 42, 50, 58},
         true},
        {"jpeg2000",
         "libopenjpeg",
         "-c:v libopenjpeg -compression_level {}",
         "%06d.jp2",
         {4, 8, 16, 32, 64, 128, 256},
         false},
        {"jpegxl", "libjxl", "-c:v libjxl -effort 7 -distance {}", "%06d.jxl", {0.1, 0.3, 1, 3, 6, 12}, false},
    };
    return all;
}

// Returns the processor time in seconds of all child programs that have ended.
double processor_seconds_of_programs() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

bool run(const std::string& command) {
    return std::system(("(" + command + ") >/dev/null 2>&1 </dev/null").c_str()) == 0;
}

std::string quoted(const std::filesystem::path& path) {
    std::string result = "'";
    for (const char c : path.string()) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

// Hogels as pictures of integers, in rows of alternating direction, so that consecutive pictures are neighbours.
class Pictures {
  public:
    Pictures(const LightFieldBuffer& field, bool video) : field_(field), video_(video), top_(video ? 1023 : 65535) {
        for (const float value : field.radiance.elements()) {
            peak_ = std::max(peak_, value);
            signal_ += static_cast<double>(value) * value;
        }
    }
    // Video coders need chrominance too, which has half the width and height and is constant.
    std::size_t samples_of_picture() const {
        const std::size_t luminance = field_.grid().directions();
        return video_ ? luminance + luminance / 2 : luminance;
    }
    void write(const std::filesystem::path& path) const {
        std::ofstream file(path, std::ios::binary);
        std::vector<std::uint16_t> picture(samples_of_picture(), static_cast<std::uint16_t>((top_ + 1) / 2));
        for (std::size_t k = 0; k < field_.grid().hogels(); ++k) {
            std::ranges::transform(hogel(k), picture.begin(), [&](float value) { return level_of(value); });
            file.write(reinterpret_cast<const char*>(picture.data()), std::streamsize(2 * picture.size()));
        }
    }
    // Returns the SQNR of a file written by write().
    double sqnr_of(const std::filesystem::path& path) const {
        std::ifstream file(path, std::ios::binary);
        std::vector<std::uint16_t> picture(samples_of_picture());
        double error = 0;
        for (std::size_t k = 0; k < field_.grid().hogels(); ++k) {
            if (!file.read(reinterpret_cast<char*>(picture.data()), std::streamsize(2 * picture.size()))) return 0;
            const std::span<const float> truth = hogel(k);
            for (std::size_t i = 0; i < truth.size(); ++i) {
                const double difference = truth[i] - double(picture[i]) * peak_ / top_;
                error += difference * difference;
            }
        }
        return 10 * std::log10(signal_ / error);
    }
    void write_each(const std::filesystem::path& folder) const {
        std::vector<std::uint8_t> bytes(2 * samples_of_picture());
        for (std::size_t k = 0; k < field_.grid().hogels(); ++k) {
            for (std::size_t n = 0; n < samples_of_picture(); ++n) {
                const std::uint16_t level = level_of(hogel(k)[n]);
                bytes[2 * n] = static_cast<std::uint8_t>(level >> 8);
                bytes[2 * n + 1] = static_cast<std::uint8_t>(level & 255);
            }
            std::ofstream file(folder / fmt::format("{:06}.pgm", k), std::ios::binary);
            file << fmt::format("P5\n{} {}\n{}\n", field_.grid().directions_u, field_.grid().directions_v, top_);
            file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        }
    }
    // Returns the SQNR of a folder of files without a header, low byte first.
    double sqnr_of_each(const std::filesystem::path& folder) const {
        std::vector<std::uint8_t> bytes(2 * samples_of_picture());
        double error = 0;
        for (std::size_t k = 0; k < field_.grid().hogels(); ++k) {
            std::ifstream file(folder / fmt::format("{:06}.rawl", k), std::ios::binary);
            if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()))) return 0;
            const std::span<const float> truth = hogel(k);
            for (std::size_t n = 0; n < truth.size(); ++n) {
                const double difference = truth[n] - double(bytes[2 * n + 1] << 8 | bytes[2 * n]) * peak_ / top_;
                error += difference * difference;
            }
        }
        return 10 * std::log10(signal_ / error);
    }
    std::string format() const {
        return fmt::format("-f rawvideo -pix_fmt {} -s {}x{}", video_ ? "yuv420p10le" : "gray16le",
                           field_.grid().directions_u, field_.grid().directions_v);
    }

  private:
    std::uint16_t level_of(float value) const {
        return static_cast<std::uint16_t>(std::lround(std::clamp(value / peak_, 0.0f, 1.0f) * float(top_)));
    }
    std::span<const float> hogel(std::size_t k) const {
        const std::size_t t = k / field_.grid().hogels_s, s = k % field_.grid().hogels_s;
        return field_.radiance[0][t][t % 2 == 0 ? s : field_.grid().hogels_s - 1 - s].elements();
    }

    const LightFieldBuffer& field_;
    bool video_;
    int top_;
    float peak_ = 0;
    double signal_ = 0;
};

double bytes_in(const std::filesystem::path& folder) {
    double sum = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) sum += static_cast<double>(entry.file_size());
    return sum;
}

// Measures zfp on the array of floats, with absolute tolerances. Axes of one sample are left out.
std::optional<RateCurve> measure_zfp(const LightFieldBuffer& field, const QualityRange& range) {
    if (!run("command -v zfp")) return std::nullopt;
    const TemporaryFolder folder;
    const std::filesystem::path raw = folder.path() / "raw", back = folder.path() / "back",
                                coded = folder.path() / "coded";
    const std::span<const float> truth = field.radiance.elements();
    std::ofstream(raw, std::ios::binary)
        .write(reinterpret_cast<const char*>(truth.data()), std::streamsize(truth.size_bytes()));
    std::string axes;
    int count = 0;
    for (std::size_t axis = 5; axis-- > 1;)
        if (const std::size_t n = field.radiance.extent(axis); n > 1) {
            axes += fmt::format(" {}", n);
            ++count;
        }
    if (count == 0) return std::nullopt;
    double signal = 0;
    for (const float value : truth) signal += static_cast<double>(value) * value;
    const double samples = static_cast<double>(truth.size());
    // The errors of zfp are far below its tolerance.
    double tolerance = std::sqrt(signal / samples) * std::pow(10, -range.high / 20);
    RateCurve curve{"zfp", {}};
    std::vector<float> decoded(truth.size());
    for (int k = 0; k < 16; ++k, tolerance *= 2) {
        stop_if_interrupted();
        const std::string what = fmt::format("zfp -q -f -{}{} -a {} -z {}", count, axes, tolerance, quoted(coded));
        const double began = processor_seconds_of_programs();
        if (!run(fmt::format("{} -i {}", what, quoted(raw)))) break;
        const double between = processor_seconds_of_programs();
        if (!run(fmt::format("{} -o {}", what, quoted(back)))) break;
        const double ended = processor_seconds_of_programs();
        std::ifstream file(back, std::ios::binary);
        if (!file.read(reinterpret_cast<char*>(decoded.data()), std::streamsize(truth.size_bytes()))) break;
        double error = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) error += std::pow(double(truth[i]) - decoded[i], 2);
        const double sqnr = 10 * std::log10(signal / error);
        curve.points.push_back({samples / (8 * static_cast<double>(std::filesystem::file_size(coded))), sqnr,
                                1e-6 * samples / (between - began), 1e-6 * samples / (ended - between)});
        if (sqnr < range.low) break;
    }
    return curve;
}

// Measures the programs of OpenJPEG on one picture per hogel, with compression ratios relative to 16 bits per sample.
std::optional<RateCurve> measure_openjpeg(const LightFieldBuffer& field, const QualityRange& range) {
    if (!run("command -v opj_compress && command -v opj_decompress")) return std::nullopt;
    const TemporaryFolder folder;
    const std::filesystem::path plain = folder.path() / "plain", coded = folder.path() / "coded";
    const Pictures pictures(field, false);
    RateCurve curve{"OpenJPEG", {}};
    const double samples = field.grid().samples() * 1e-6;
    for (const int ratio : {2, 3, 4, 6, 8, 12, 16, 24, 32, 64, 128, 256}) {
        stop_if_interrupted();
        for (const auto& path : {plain, coded}) {
            std::filesystem::remove_all(path);
            std::filesystem::create_directory(path);
        }
        pictures.write_each(plain);
        const double began = processor_seconds_of_programs();
        if (!run(fmt::format("opj_compress -ImgDir {} -OutFor j2k -r {}", quoted(plain), ratio))) return std::nullopt;
        const double between = processor_seconds_of_programs();
        for (const auto& entry : std::filesystem::directory_iterator(plain))
            if (entry.path().extension() == ".j2k")
                std::filesystem::rename(entry.path(), coded / entry.path().filename());
        const double bytes = bytes_in(coded);
        const double start = processor_seconds_of_programs();
        if (!run(fmt::format("opj_decompress -ImgDir {} -OutFor rawl", quoted(coded)))) return std::nullopt;
        const double ended = processor_seconds_of_programs();
        const double sqnr = pictures.sqnr_of_each(coded);
        curve.points.push_back(
            {samples * 1e6 / (8 * bytes), sqnr, samples / (between - began), samples / (ended - start)});
        if (sqnr < range.low) break;
    }
    return curve;
}

std::optional<RateCurve> measure_ffmpeg(const LightFieldBuffer& field, const FfmpegCoder& coder,
                                        const QualityRange& range) {
    if (!run(fmt::format("ffmpeg -hide_banner -h encoder={} | grep -q '^Encoder {}'", coder.needs, coder.needs)))
        return std::nullopt;
    const TemporaryFolder folder;
    const Pictures pictures(field, coder.video);
    const std::filesystem::path raw = folder.path() / "raw", back = folder.path() / "back",
                                coded = folder.path() / "coded";
    pictures.write(raw);
    RateCurve curve{coder.name, {}};
    const double samples = field.grid().samples() * 1e-6;
    for (const double quality : coder.qualities) {
        stop_if_interrupted();
        std::filesystem::remove_all(coded);
        std::filesystem::create_directory(coded);
        const double began = processor_seconds_of_programs();
        const bool encoded =
            run(fmt::format("ffmpeg -y -threads 1 {} -i {} {} {}", pictures.format(), quoted(raw),
                            fmt::format(fmt::runtime(coder.encoder), quality), quoted(coded / coder.file)));
        const double between = processor_seconds_of_programs();
        const bool decoded = encoded && run(fmt::format("ffmpeg -y -threads 1 -i {} -threads 1 {} {}",
                                                        quoted(coded / coder.file), pictures.format(), quoted(back)));
        const double ended = processor_seconds_of_programs();
        if (!decoded) continue;
        const double sqnr = pictures.sqnr_of(back);
        curve.points.push_back(
            {samples * 1e6 / (8 * bytes_in(coded)), sqnr, samples / (between - began), samples / (ended - between)});
        if (sqnr < range.low) break;
    }
    return curve;
}

}  // namespace

std::vector<std::string> coder_peers() {
    std::vector<std::string> names{"zfp", "openexr-dwaa", "openexr-dwab", "openjpeg"};
    for (const FfmpegCoder& coder : ffmpeg_coders()) names.emplace_back(coder.name);
    return names;
}

std::optional<RateCurve> measure_coder_peer(const LightFieldBuffer& field, const std::string& name,
                                            const QualityRange& range) {
    if (name == "zfp") return measure_zfp(field, range);
    if (name == "openexr-dwaa" || name == "openexr-dwab") return measure_openexr(field, name.substr(8), range);
    if (name == "openjpeg") return measure_openjpeg(field, range);
    return measure_ffmpeg(field, *std::ranges::find(ffmpeg_coders(), name, &FfmpegCoder::name), range);
}

}  // namespace hogel::bench
