// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "commands.h"
#include "hogel/core/parallel.h"
#include "hogel/files.h"
#include "hogel/image.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string a, b;
    std::optional<double> min_psnr, min_sqnr;
};

// Sums over samples of a signal f and its approximation f'.
struct Difference {
    double count = 0, signal = 0, error = 0;  // N, Σ|f|², Σ|f − f'|²
    double peak = 0, max_error = 0;           // max |f|, max |f − f'|

    void add(double magnitude, double difference) {
        count += 1;
        signal += magnitude * magnitude;
        error += difference * difference;
        peak = std::max(peak, magnitude);
        max_error = std::max(max_error, difference);
    }
    void add(const Difference& other) {
        count += other.count;
        signal += other.signal;
        error += other.error;
        peak = std::max(peak, other.peak);
        max_error = std::max(max_error, other.max_error);
    }
    double sqnr() const { return decibels(signal); }
    double psnr() const { return decibels(peak * peak * count); }

  private:
    double decibels(double power) const {
        if (error == 0) return std::numeric_limits<double>::infinity();
        return 10 * std::log10(power / error);
    }
};

// A range of hogels or samples cut into blocks of at most `width` × `height`: block i.
struct Blocks {
    std::size_t columns, rows, width, height;

    std::size_t across() const { return (columns + width - 1) / width; }
    std::size_t count() const { return across() * ((rows + height - 1) / height); }
    Region operator[](std::size_t i) const {
        const std::size_t x = i % across() * width, y = i / across() * height;
        return {x, y, std::min(width, columns - x), std::min(height, rows - y)};
    }
};

Difference sum_blocks(const Blocks& blocks, Stage& stage,
                      const std::function<Difference(const Region&)>& compare_block) {
    Difference sum;
    const Progress progress = stage.progress();
    core::parallel_ordered<Difference>(
        blocks.count(), core::default_in_flight(), [&](std::size_t i) { return compare_block(blocks[i]); },
        [&](std::size_t i, Difference& block) {
            sum.add(block);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(blocks.count()));
        });
    return sum;
}

Difference compare_faces(const LightFieldSource& a, const LightFieldSource& b, Stage& stage) {
    const LightFieldGrid& grid = a.grid();
    const HogelRange tile = default_tile(grid);
    return sum_blocks({grid.hogels_s, grid.hogels_t, tile.ns, tile.nt}, stage, [&](const Region& block) {
        const HogelRange range{block.x0, block.y0, block.width, block.height};
        LightFieldTile of_a(grid, range, false), of_b(grid, range, false);
        a.read(of_a);
        b.read(of_b);
        Difference difference;
        for (std::size_t i = 0; i < of_a.radiance.size(); ++i) {
            const double f = of_a.radiance.data()[i], g = of_b.radiance.data()[i];
            difference.add(std::abs(f), std::abs(f - g));
        }
        return difference;
    });
}

Difference compare_light_fields(const Options& options, const Session& session) {
    const auto a = open_light_field_faces(options.a), b = open_light_field_faces(options.b);
    bool alike = a.size() == b.size();
    for (std::size_t i = 0; alike && i < a.size(); ++i) alike = a[i]->grid() == b[i]->grid();
    if (!alike)
        throw Error(ErrorCode::bad_input, fmt::format("{} and {} are sampled differently", options.a, options.b));
    Stage stage(session, "comparing");
    Difference sum;
    for (std::size_t i = 0; i < a.size(); ++i) sum.add(compare_faces(*a[i], *b[i], stage));
    return sum;
}

Difference compare_holograms(const Options& options, const Session& session) {
    const HologramFile a = open_hologram(options.a), b = open_hologram(options.b);
    bool alike = a.fields.size() == b.fields.size();
    for (std::size_t i = 0; alike && i < a.fields.size(); ++i) alike = a.fields[i]->grid() == b.fields[i]->grid();
    if (!alike)
        throw Error(ErrorCode::bad_input, fmt::format("{} and {} are sampled differently", options.a, options.b));
    Stage stage(session, "comparing");
    Difference sum;
    for (std::size_t i = 0; i < a.fields.size(); ++i) {
        const FieldSource &of_a = *a.fields[i], &of_b = *b.fields[i];
        const std::size_t aligned = std::max<std::size_t>(1, 512 / of_a.alignment()) * of_a.alignment();
        const Grid& plane = of_a.grid().plane;
        sum.add(sum_blocks({plane.width, plane.height, aligned, aligned}, stage, [&](const Region& block) {
            Array<std::complex<float>, 2> f({block.height, block.width}), g({block.height, block.width});
            of_a.read(block, 0, f);
            of_b.read(block, 0, g);
            Difference difference;
            for (std::size_t k = 0; k < f.size(); ++k)
                difference.add(std::abs(f.data()[k]), std::abs(f.data()[k] - g.data()[k]));
            return difference;
        }));
    }
    return sum;
}

// Exit status 1 where a bound was given and is missed; a bound on what was not measured is a usage error.
bool misses(const Session& session, const char* name, std::optional<double> bound, std::optional<double> value) {
    if (!bound) return false;
    if (!value) throw Error(ErrorCode::usage, fmt::format("--min-{}: pictures have no {}; use --min-psnr", name, name));
    if (*value >= *bound) return false;
    session.say(fmt::format("hogel: {} is {:.4f} dB, below {}", name, *value, *bound));
    return true;
}

int compare_files(const Options& options, const Session& session) {
    const FileKind kind = file_kind(options.a);
    if (file_kind(options.b) != kind)
        throw Error(ErrorCode::bad_input, fmt::format("{} and {} are not files of one kind", options.a, options.b));
    std::optional<double> psnr, sqnr;
    if (kind == FileKind::picture) {
        if (options.min_sqnr) misses(session, "sqnr", options.min_sqnr, sqnr);
        const ImageComparison result = compare(read_image(options.a), read_image(options.b));
        psnr = result.psnr;
        session.result({{"psnr", result.psnr}, {"ssim", result.ssim}, {"max_error", result.max_error}},
                       fmt::format("psnr       {:.4f} dB\nssim       {:.6f}\nmax_error  {:.6g}\n", result.psnr,
                                   result.ssim, result.max_error));
    } else if (kind == FileKind::light_field || kind == FileKind::hologram) {
        const Difference result = kind == FileKind::light_field ? compare_light_fields(options, session)
                                                                : compare_holograms(options, session);
        psnr = result.psnr();
        sqnr = result.sqnr();
        session.result({{"sqnr", *sqnr}, {"psnr", *psnr}, {"max_error", result.max_error}},
                       fmt::format("sqnr       {:.4f} dB\npsnr       {:.4f} dB\nmax_error  {:.6g}\n", *sqnr, *psnr,
                                   result.max_error));
    } else {
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is neither a picture, a light field nor a hologram", options.a));
    }
    const bool low_psnr = misses(session, "psnr", options.min_psnr, psnr);
    const bool low_sqnr = misses(session, "sqnr", options.min_sqnr, sqnr);
    return low_psnr || low_sqnr ? 1 : 0;
}

}  // namespace

void add_compare(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel compare truth.png wave.png --min-psnr 25\n"
        "  hogel compare full.h5 decoded.h5 --min-sqnr 30");
    command.positional("a", options->a, "A", "The truth: a picture, a light field or a hologram");
    command.positional("b", options->b, "B", "What is compared with it, of the same kind and size");
    command.number("--min-psnr", options->min_psnr, "DB", "Exit with status 1 below this ratio of peak to error");
    command.number("--min-sqnr", options->min_sqnr, "DB", "Exit with status 1 below this ratio of signal to error");
    add_json_flag(command, session);
    command.work([options, &session] { return compare_files(*options, session); });
}

}  // namespace hogel::cli
