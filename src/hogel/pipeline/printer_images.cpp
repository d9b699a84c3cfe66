// SPDX-License-Identifier: Apache-2.0
// Pictures for hologram printers, and the manifest that describes them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/core/json.h"
#include "hogel/core/output_file.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/exchange/scaled_view.h"
#include "hogel/exchange/transfer.h"
#include "hogel/image/formats/formats.h"
#include "hogel/pipeline.h"
#include "hogel/version.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_files = 4096;  // in a folder

// Counts of a folder's pictures, in checkpoints.
struct Counted {
    std::uint64_t bytes = 0, samples = 0, clipped = 0;
};

// Position of a hogel.
struct Hogel {
    std::size_t column = 0, row = 0;
};

// Names and order of the pictures.
class Sheets {
  public:
    Sheets(const LightFieldGrid& grid, const PrinterImageOptions& options)
        : columns_(grid.hogels_s), rows_(grid.hogels_t), is_strips_(options.rows), serpentine_(options.serpentine) {
        if (options.planes && grid.channels == 3) planes_ = {"_r", "_g", "_b"};
        per_part_ = is_strips_ || columns_ * planes_.size() > max_files ? max_files / planes_.size() : columns_;
        if (pictures() * planes_.size() <= max_files) per_part_ = pictures();
    }

    std::size_t pictures() const { return is_strips_ ? rows_ : columns_ * rows_; }
    std::size_t per_part() const { return per_part_; }
    std::size_t parts() const { return (pictures() + per_part_ - 1) / per_part_; }
    const std::vector<std::string>& planes() const { return planes_; }
    // Returns the file of picture `index` from 0, relative to the folder.
    fs::path file(std::size_t index, const std::string& plane) const {
        return part_of(index / per_part_) /
               fmt::format(fmt::runtime(name()), fmt::arg("number", index + 1), fmt::arg("plane", plane));
    }
    // Returns the folder of a part; empty if there is only one.
    fs::path part_of(std::size_t part) const {
        return parts() == 1 ? fs::path() : fs::path(fmt::format("part_{:0{}}", part + 1, digits(parts())));
    }
    // Returns the names of all files as a format of Python.
    std::string pattern() const {
        return (parts() == 1 ? "" : fmt::format("part_{{part:0{}}}/", digits(parts()))) + name();
    }
    // Returns the hogel that is printed as number i of a row.
    Hogel hogel(std::size_t i, std::size_t row) const {
        return {serpentine_ && row % 2 == 1 ? columns_ - 1 - i : i, row};
    }

  private:
    static std::size_t digits(std::size_t count) { return std::to_string(count).size(); }
    std::string name() const {
        return fmt::format("{}_{{number:0{}}}{{plane}}.png", is_strips_ ? "row" : "hogel", digits(pictures()));
    }

    std::size_t columns_, rows_;
    bool is_strips_, serpentine_;
    std::vector<std::string> planes_{""};
    std::size_t per_part_ = 0;
};

// Converts radiance to samples of pictures.
class Development {
  public:
    Development(const LightFieldGrid& grid, const PrinterImageOptions& options, double exposure)
        : options_(options), exposure_(exposure), mask_(mask_for(grid, options)) {}

    // Returns a sample, 0 to 1. `light` is the exposed light, at most 1.
    double sample(double light) const {
        const std::vector<double>& table = options_.table;
        if (table.empty()) return exchange::encode(options_.transfer, static_cast<float>(light));
        const double position = light * static_cast<double>(table.size() - 1);
        const auto i = std::min(static_cast<std::size_t>(position), table.size() - 2);
        return table[i] + (position - static_cast<double>(i)) * (table[i + 1] - table[i]);
    }

    // Writes samples of a hogel's picture from column x0 on. Returns the number of clipped samples.
    template <class T>
    std::uint64_t develop(const LightFieldTile& tile, std::size_t hogel, Array<T, 3>& picture, std::size_t x0) const {
        const auto& radiance = tile.radiance;
        const std::size_t rows = radiance.extent(3), columns = radiance.extent(4);
        std::uint64_t clipped = 0;
        for (std::size_t c = 0; c < radiance.extent(0); ++c)
            for (std::size_t v = 0; v < rows; ++v)
                for (std::size_t u = 0; u < columns; ++u) {
                    const double value = radiance(c, 0, hogel, v, u);
                    if (!std::isfinite(value)) fail_radiance(tile, hogel);
                    const double light = value * exposure_ * options_.dose[c] * static_cast<double>(mask_(v, u));
                    clipped += light > 1 ? 1 : 0;
                    const double code = sample(std::clamp(light, 0.0, 1.0)) * std::numeric_limits<T>::max();
                    std::size_t y = options_.mirror_rows ? rows - 1 - v : v,
                                x = options_.mirror_columns ? columns - 1 - u : u;
                    if (options_.transpose) std::swap(x, y);
                    picture(y, x0 + x, c) = static_cast<T>(std::lround(code));
                }
        return clipped;
    }

  private:
    [[noreturn]] static void fail_radiance(const LightFieldTile& tile, std::size_t hogel) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("the light field's radiance is not finite at hogel column {}, row {}",
                                tile.range.s0 + hogel + 1, tile.range.t0 + 1));
    }
    static Array<float, 2> mask_for(const LightFieldGrid& grid, const PrinterImageOptions& options) {
        const std::size_t rows = grid.directions_v, columns = grid.directions_u;
        Array<float, 2> mask({rows, columns}, 1.0f);
        if (options.mask.size() > 0) {
            Array<float, 3> picture({options.mask.extent(0), options.mask.extent(1), 1});
            std::ranges::copy(options.mask.elements(), picture.data());
            std::ranges::copy(exchange::scaled_view(picture, rows, columns).elements(), mask.data());
        }
        for (std::size_t v = 0; v < rows && options.circle; ++v)
            for (std::size_t u = 0; u < columns; ++u)
                if (std::hypot((2 * static_cast<double>(u) + 1) / static_cast<double>(columns) - 1,
                               (2 * static_cast<double>(v) + 1) / static_cast<double>(rows) - 1) > 1)
                    mask(v, u) = 0;
        return mask;
    }

    const PrinterImageOptions& options_;
    double exposure_;
    Array<float, 2> mask_;
};

// Returns the automatic exposure of the middle direction, from a coarse preview.
double exposure_of(const LightField& light_field) {
    constexpr std::size_t columns = 128;
    const LightField preview =
        every_nth_hogel(light_field, std::max<std::size_t>(1, light_field.grid().hogels_s / columns));
    const LightFieldGrid& grid = preview.grid();
    Image view(grid.hogels_s, grid.hogels_t, grid.channels);
    for (std::size_t t = 0; t < grid.hogels_t; ++t) {
        LightFieldTile row(grid, {0, t, grid.hogels_s, 1}, false);
        preview.front().read(row);
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t c = 0; c < grid.channels; ++c)
                view.pixels(t, s, c) = row.radiance(c, 0, s, grid.directions_v / 2, grid.directions_u / 2);
    }
    view.provenance = light_field.provenance();
    return automatic_exposure(view);
}

void require_options(const PrinterImageOptions& options) {
    const auto is_positive = [](double value) { return std::isfinite(value) && value > 0; };
    if (!(options.exposure == 0 || is_positive(options.exposure)))
        throw Error(ErrorCode::usage, "exposure", "the exposure must be a positive number, or 0 for automatic");
    if (!std::ranges::all_of(options.dose, is_positive))
        throw Error(ErrorCode::usage, "dose", "the doses of R, G and B must be positive numbers");
    if (options.bits != 8 && options.bits != 16)
        throw Error(ErrorCode::usage, "bits",
                    fmt::format("PNG files hold 8 or 16 bits a sample, not {}", options.bits));
    const auto is_sample = [](double value) { return value >= 0 && value <= 1; };
    if (options.table.size() == 1 || !std::ranges::all_of(options.table, is_sample))
        throw Error(ErrorCode::usage, "table", "a table has two or more numbers from 0 to 1");
    if (!std::ranges::all_of(options.mask.elements(), [&](float value) { return is_sample(value); }))
        throw Error(ErrorCode::usage, "mask", "a mask has numbers from 0 to 1");
}

// Writes the pictures of a light field.
class Printer {
  public:
    Printer(const LightField& light_field, const PrinterImageOptions& options, double exposure)
        : light_field_(light_field),
          grid_(light_field.grid()),
          options_(options),
          sheets_(grid_, options),
          development_(grid_, options, exposure) {
        width_ = options.transpose ? grid_.directions_v : grid_.directions_u;
        height_ = options.transpose ? grid_.directions_u : grid_.directions_v;
        curve_ = options.transfer == Transfer::srgb && options.table.empty() ? image::Curve::srgb : image::Curve::none;
        if (options.rows) texts_ = with_history(options.metadata, to_metadata(light_field.provenance()));
    }

    const Sheets& sheets() const { return sheets_; }
    std::size_t width() const { return width_; }
    std::size_t height() const { return height_; }

    // Writes the pictures of a part into a temporary folder.
    Counted write_part(std::size_t part, const fs::path& temporary, const Progress& progress) const {
        return options_.bits == 8 ? write_part<std::uint8_t>(part, temporary, progress)
                                  : write_part<std::uint16_t>(part, temporary, progress);
    }

  private:
    template <class T>
    Counted write_part(std::size_t part, const fs::path& temporary, const Progress& progress) const {
        Counted all;
        const std::size_t first = part * sheets_.per_part(),
                          last = std::min(first + sheets_.per_part(), sheets_.pictures());
        const std::size_t per_row = options_.rows ? 1 : grid_.hogels_s;
        for (std::size_t begin = first; begin < last;) {
            progress.report(static_cast<double>(begin) / static_cast<double>(sheets_.pictures()));
            const std::size_t end = std::min(last, (begin / per_row + 1) * per_row);
            const Counted counted = write_row<T>(begin, end, temporary);
            all.bytes += counted.bytes, all.samples += counted.samples, all.clipped += counted.clipped;
            begin = end;
        }
        return all;
    }

    // Writes pictures of a single row of hogels.
    template <class T>
    Counted write_row(std::size_t begin, std::size_t end, const fs::path& temporary) const {
        const std::size_t t = options_.rows ? begin : begin / grid_.hogels_s;
        LightFieldTile row(grid_, {0, t, grid_.hogels_s, 1}, false);
        light_field_.front().read(row);
        std::vector<Counted> counts(end - begin);
        work::parallel_for(end - begin, [&](std::size_t i) {
            const std::size_t across = options_.rows ? grid_.hogels_s : 1;
            Array<T, 3> picture({height_, across * width_, grid_.channels});
            for (std::size_t j = 0; j < across; ++j) {
                const std::size_t printed = options_.rows ? j : (begin + i) % grid_.hogels_s;
                counts[i].clipped += development_.develop(row, sheets_.hogel(printed, t).column, picture, j * width_);
            }
            counts[i].samples = picture.size();
            counts[i].bytes = write_picture(begin + i, picture, temporary);
        });
        Counted all;
        for (const Counted& each : counts)
            all.bytes += each.bytes, all.samples += each.samples, all.clipped += each.clipped;
        return all;
    }

    // Returns the size of the files.
    template <class T>
    std::uint64_t write_picture(std::size_t index, const Array<T, 3>& picture, const fs::path& temporary) const {
        std::uint64_t bytes = 0;
        for (std::size_t plane = 0; plane < sheets_.planes().size(); ++plane) {
            const fs::path name = sheets_.file(index, sheets_.planes()[plane]).filename();
            Array<T, 3> grey;
            if (sheets_.planes().size() > 1) {
                grey = Array<T, 3>({picture.extent(0), picture.extent(1), 1});
                for (std::size_t i = 0; i < grey.size(); ++i)
                    grey.data()[i] = picture.data()[i * picture.extent(2) + plane];
            }
            const std::vector<unsigned char> file =
                image::png_file((grey.size() > 0 ? grey : picture).view(), texts_, curve_);
            core::write_file(temporary / name, file);
            bytes += file.size();
        }
        return bytes;
    }

    const LightField& light_field_;
    const LightFieldGrid& grid_;
    const PrinterImageOptions& options_;
    Sheets sheets_;
    Development development_;
    std::size_t width_ = 0, height_ = 0;
    image::Curve curve_ = image::Curve::srgb;
    Metadata texts_;
};

// Returns the text of manifest.json, docs/printing.md.
std::string manifest_of(const Printer& printer, const LightField& light_field, const PrinterImageOptions& options,
                        const PrinterImages& made) {
    const LightFieldGrid& grid = light_field.grid();
    const Sheets& sheets = printer.sheets();
    nlohmann::ordered_json json{
        {"format", "hogel printer pictures"},
        {"version", 1},
        {"software", "hogel " HOGEL_VERSION},
        {"hogels", {{"columns", grid.hogels_s}, {"rows", grid.hogels_t}, {"pitch_m", grid.pitch}}},
        {"directions",
         {{"columns", grid.directions_u},
          {"rows", grid.directions_v},
          {"unit", grid.has_frequencies() ? "sine" : "tangent"},
          {"center", {grid.center_u(), grid.center_v()}},
          {"half", {grid.half_u(), grid.half_v()}}}},
        {"pictures",
         {{"of", options.rows ? "rows" : "hogels"},
          {"count", sheets.pictures()},
          {"pattern", sheets.pattern()},
          {"per_part", sheets.per_part()},
          {"planes", sheets.planes()},
          {"width", printer.width() * (options.rows ? grid.hogels_s : 1)},
          {"height", printer.height()}}},
        {"order", options.serpentine ? "serpentine" : "rows"},
        {"mirror", {{"columns", options.mirror_columns}, {"rows", options.mirror_rows}}},
        {"transpose", options.transpose},
        {"masked", options.circle || options.mask.size() > 0},
        {"light",
         {{"channels", grid.channels},
          {"exposure", made.exposure},
          {"dose", options.dose},
          {"bits", options.bits},
          {"transfer", options.table.empty() ? transfer_names()[static_cast<std::size_t>(options.transfer)] : "table"},
          {"table", options.table},
          {"samples", made.samples},
          {"clipped", made.clipped}}}};
    for (const auto& [name, text] : with_history(options.metadata, to_metadata(light_field.provenance())))
        json["run"][name] = text;
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

PrinterImages write_printer_images(const fs::path& folder, const LightField& rays, const PrinterImageOptions& options,
                                   const Progress& progress) {
    const core::StopScope scope(progress);
    require_options(options);
    const LightField light_field = with_common_directions(rays);  // the optics are the same for all hogels
    PrinterImages made;
    made.exposure = options.exposure > 0 ? options.exposure : exposure_of(light_field);
    const Printer printer(light_field, options, made.exposure);
    const Sheets& sheets = printer.sheets();
    made.pictures = sheets.pictures();
    made.first = folder / sheets.file(0, sheets.planes().front());
    made.last = folder / sheets.file(made.pictures - 1, sheets.planes().back());
    made.manifest = folder / "manifest.json";
    const auto write_part = [&](std::size_t part) {
        const fs::path target = sheets.parts() == 1 ? folder : folder / sheets.part_of(part);
        std::error_code error;
        fs::create_directories(target, error);  // write_set() reports failure
        Counted counted;
        core::write_set(target,
                        [&](const fs::path& temporary) { counted = printer.write_part(part, temporary, progress); });
        return counted;
    };
    work::shared_jobs<Counted>(
        sheets.parts(), {}, write_part,
        [&](std::size_t, const Counted& counted) {
            made.bytes += counted.bytes, made.samples += counted.samples, made.clipped += counted.clipped;
        },
        work::DoneBy::all_ranks);
    write_text(made.manifest, manifest_of(printer, light_field, options, made));
    return made;
}

}  // namespace hogel
