// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <fmt/format.h>

#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel {

using namespace io::arrays;

namespace {

enum class Format { npy, npz, mat, ohc, exr, picture };

std::vector<unsigned char> first_bytes(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    std::vector<unsigned char> start(std::min<std::uint64_t>(file.size(), 128));
    file.read(0, start.data(), start.size());
    return start;
}

Format format_of(const std::filesystem::path& path) {
    const std::vector<unsigned char> start = first_bytes(path);
    if (is_npy(start)) return Format::npy;
    if (is_zip(start)) return Format::npz;
    if (is_mat(start)) return Format::mat;
    if (is_ohc(start)) return Format::ohc;
    return is_exr_field(path, start) ? Format::exr : Format::picture;
}

}  // namespace

bool is_external_field(const std::filesystem::path& path) {
    return format_of(path) != Format::picture || is_picture_field(path);
}

ExternalFacts external_facts(const std::filesystem::path& path, const ExternalField& description) {
    switch (format_of(path)) {
        case Format::npy:
            return npy_facts(path);
        case Format::npz:
            return npz_facts(path, description);
        case Format::mat:
            return mat_facts(path, description);
        case Format::ohc:
            return ohc_facts(path);
        case Format::exr:
            return exr_facts(path);
        case Format::picture:
            break;
    }
    return picture_facts(path, description);
}

std::shared_ptr<const FieldSource> open_external_field(const std::filesystem::path& path,
                                                       const ExternalField& description) {
    const Format format = format_of(path);
    if (format == Format::picture) return open_picture_field(path, description);
    if (!description.imaginary.empty() || !description.phases.empty())
        throw Error(ErrorCode::usage, description.phases.empty() ? "imaginary" : "phases",
                    fmt::format("'{}' holds complete fields; separate {} are for pictures only", path.string(),
                                description.phases.empty() ? "imaginary parts" : "phases"));
    if (description.zero)
        throw Error(ErrorCode::usage, "zero",
                    fmt::format("'{}' holds complete fields; a zero level is for pictures only", path.string()));
    switch (format) {
        case Format::npy:
            return open_npy(path, description);
        case Format::npz:
            return open_npz(path, description);
        case Format::mat:
            return open_mat(path, description);
        case Format::ohc:
            return open_ohc(path, description);
        default:
            return open_exr_field(path, description);
    }
}

}  // namespace hogel
