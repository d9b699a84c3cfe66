// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "commands.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string a, b;
    std::optional<double> min_psnr, min_sqnr, exposure;
    FieldParameters field;
};

SampleComparison compare_samples(const Options& options, FileKind kind, const Session& session) {
    Stage stage(session, "comparing");
    if (kind == FileKind::light_field)
        return compare(open_light_field_or_views(options.a), open_light_field_or_views(options.b), stage.progress());
    const auto open = [&](const std::string& name) {
        if (!options.field.is_external(name)) return open_hologram(name);
        FieldParameters field = options.field;
        OpenedFields opened = field.open(name, *session.command);
        for (const std::string& note : opened.notes) session.say(note);
        return std::move(opened.fields);
    };
    const Fields a = open(options.a), b = open(options.b);
    return compare(a, b, stage.progress());
}

// Returns whether a bound was given and the value is below it (exit status 1). Throws Error(usage) if the value was not
// measured.
bool is_below(const Session& session, const char* name, std::optional<double> bound, std::optional<double> value) {
    if (!bound) return false;
    if (!value) throw Error(ErrorCode::usage, fmt::format("--min-{}: pictures have no {}; use --min-psnr", name, name));
    if (*value >= *bound) return false;
    session.say(fmt::format("hogel: {} is {:.4f} dB, below {}", name, *value, *bound));
    return true;
}

FileKind kind_of(const std::string& path, const FieldParameters& field) {
    if (field.is_external(path)) return FileKind::hologram;
    return is_view_set(path) ? FileKind::light_field : file_kind(path);
}

// Returns the common kind of both files. A pattern counts as a picture if the other file is one, otherwise as a field.
FileKind common_kind(const Options& options) {
    const FileKind a = kind_of(options.a, options.field), b = kind_of(options.b, options.field);
    const auto is_picture = [&](const std::string& path, FileKind kind) {
        return kind == FileKind::picture || (kind == FileKind::hologram && options.field.is_pattern(path));
    };
    if (is_picture(options.a, a) && is_picture(options.b, b)) return FileKind::picture;
    if (a != b)
        throw Error(ErrorCode::bad_input, fmt::format("{} and {} are not files of one kind", options.a, options.b));
    return a;
}

int compare_files(const Options& options, const Session& session) {
    const FileKind kind = common_kind(options);
    std::optional<double> psnr, sqnr;
    if (kind == FileKind::picture) {
        if (options.min_sqnr) is_below(session, "sqnr", options.min_sqnr, sqnr);
        const Image truth = read_image(options.a);
        // Scales radiances above display white instead of clamping them.
        const double exposure = options.exposure.value_or(std::min(1.0, automatic_exposure(truth)));
        const ImageComparison result = compare(truth, read_image(options.b), exposure);
        psnr = result.psnr;
        if (exposure != 1) session.say(fmt::format("hogel: compared with an exposure of {:.6g}", exposure));
        session.result(
            {{"psnr", result.psnr}, {"ssim", result.ssim}, {"max_error", result.max_error}, {"exposure", exposure}},
            fmt::format("psnr       {:.4f} dB\nssim       {:.6f}\nmax_error  {:.6g}\n", result.psnr, result.ssim,
                        result.max_error));
    } else if (kind == FileKind::light_field || kind == FileKind::hologram) {
        const SampleComparison result = compare_samples(options, kind, session);
        psnr = result.psnr;
        sqnr = result.sqnr;
        session.result({{"sqnr", *sqnr}, {"psnr", *psnr}, {"max_error", result.max_error}},
                       fmt::format("sqnr       {:.4f} dB\npsnr       {:.4f} dB\nmax_error  {:.6g}\n", *sqnr, *psnr,
                                   result.max_error));
    } else {
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is neither a picture, a light field nor a hologram", options.a));
    }
    const bool low_psnr = is_below(session, "psnr", options.min_psnr, psnr);
    const bool low_sqnr = is_below(session, "sqnr", options.min_sqnr, sqnr);
    return low_psnr || low_sqnr ? 1 : 0;
}

}  // namespace

void add_compare(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel compare truth.png wave.png --min-psnr 25\n"
        "  hogel compare full.h5 decoded.h5 --min-sqnr 30");
    command.positional("a", options->a, "A", "Reference: a picture, a light field or a hologram");
    command.positional("b", options->b, "B", "File to compare with it, of the same kind and size");
    command.number("--min-psnr", options->min_psnr, "DB", "Exit with status 1 below this peak signal-to-noise ratio");
    command.number("--min-sqnr", options->min_sqnr, "DB", "Exit with status 1 below this ratio of signal to error");
    command.number("--exposure", options->exposure, "NUMBER",
                   "Factor of linear values of pictures (default: 1, or less if A is brighter than white)");
    options->field.declare(command, true, true);
    command.work([options, &session] { return compare_files(*options, session); });
}

}  // namespace hogel::cli
