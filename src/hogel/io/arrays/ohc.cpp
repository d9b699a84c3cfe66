// SPDX-License-Identifier: Apache-2.0
// Complex fields of OpenHolo, packed and little-endian: a file header of 24 bytes ("OH", file size, version, offset of
// the samples), a field header of 65 bytes, the wavelengths as doubles, and the samples, real parts or amplitudes
// before imaginary parts or phases, row-major. Wavelengths are interleaved or one after the other.
#include <fmt/format.h>

#include <array>
#include <cstring>

#include "hogel/error.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {
namespace {

constexpr std::size_t file_head = 24, field_head = 65;

enum class Parts : unsigned char { amplitude_phase = 1, real_imaginary = 2, amplitude = 3, phase = 4 };

struct OhcFile {
    ExternalFacts facts;
    Parts parts = Parts::real_imaginary;
    Number number = Number::real;
    bool side_by_side = false;  // whether wavelengths are interleaved
    std::uint64_t begin = 0;    // of the samples

    bool two() const { return parts == Parts::amplitude_phase || parts == Parts::real_imaginary; }
};

template <class T>
T value_at(std::span<const unsigned char> bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, &bytes[offset], sizeof value);
    return value;
}

// Returns the unit in metres; files without a unit use metres.
double unit_of(const std::filesystem::path& path, unsigned char unit) {
    constexpr std::array<double, 6> metres{1, 1, 1e-2, 1e-3, 1e-6, 1e-9};
    if (unit >= metres.size()) fail_external(path, fmt::format("its unit of length {} is not known", unit));
    return metres[unit];
}

void read_kinds(const std::filesystem::path& path, std::span<const unsigned char> head, OhcFile& file) {
    constexpr unsigned char each_colour = 2, singles = 9, doubles = 10, directly = 1, last_kind = 4;
    // From byte 33: colour type, colour arrangement, wavelength unit, number type, storage, parts.
    const unsigned char arrangement = head[34], type = head[36], stored = head[37], parts = head[38];
    if (type != singles && type != doubles)
        fail_external(path, fmt::format("its numbers are of type {}; single and double floats are read", type));
    if (stored > directly) fail_external(path, "its samples are in other files, which are not read");
    if (parts == 0 || parts > last_kind) fail_external(path, fmt::format("its field encoding {} is unknown", parts));
    file.number = type == singles ? Number::single : Number::real;
    file.parts = Parts{parts};
    file.side_by_side = arrangement != each_colour;
}

OhcFile parse(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    if (bytes.size() < file_head + field_head) fail_external(path, "it is truncated inside its header");
    OhcFile file;
    file.begin = value_at<std::uint32_t>(bytes, 20);
    const std::span<const unsigned char> head = bytes.subspan(file_head, field_head);
    ExternalFacts& facts = file.facts;
    facts.format = "ohc";
    facts.width = value_at<std::uint32_t>(head, 4);
    facts.height = value_at<std::uint32_t>(head, 8);
    const double pitch_unit = unit_of(path, head[28]), wave_unit = unit_of(path, head[35]);
    facts.pitch_x = value_at<double>(head, 12) * pitch_unit;
    facts.pitch_y = value_at<double>(head, 20) * pitch_unit;
    facts.colours = value_at<std::uint32_t>(head, 29);
    read_kinds(path, head, file);
    const std::size_t table = file_head + field_head;
    if (facts.colours == 0 || facts.colours > (bytes.size() - table) / 8)
        fail_external(path, fmt::format("its header says that it has {} wavelengths", facts.colours));
    for (std::size_t i = 0; i < facts.colours; ++i)
        facts.wavelengths.push_back(value_at<double>(bytes, table + 8 * i) * wave_unit);
    if (file.begin < table + 8 * facts.colours || file.begin > bytes.size())
        fail_external(path, fmt::format("its samples cannot begin at byte {}", file.begin));
    std::uint64_t remaining =
        (bytes.size() - file.begin) / bytes_of(file.number) / (file.two() ? 2 : 1) / facts.colours;
    if (facts.width > 0 && facts.height > 0 && remaining / facts.width / facts.height == 0)
        fail_external(path, fmt::format("it is truncated: {} bytes are too few for {} fields of {}x{} samples",
                                        bytes.size() - file.begin, facts.colours, facts.width, facts.height));
    facts.numbers = fmt::format("{}, {} floats",
                                file.parts == Parts::real_imaginary    ? "complex"
                                : file.parts == Parts::amplitude_phase ? "amplitudes and phases"
                                : file.parts == Parts::phase           ? "phases"
                                                                       : "amplitudes",
                                file.number == Number::single ? "single" : "double");
    return file;
}

}  // namespace

bool is_ohc(std::span<const unsigned char> start) {
    // Other files begin with "OH" too; check the reserved zeros as well.
    return start.size() >= file_head + field_head && start[0] == 'O' && start[1] == 'H' &&
           value_at<std::uint32_t>(start, 12) == 0 && value_at<std::uint32_t>(start, 16) == 0;
}

ExternalFacts ohc_facts(const std::filesystem::path& path) { return parse(path, all_bytes(path)).facts; }

std::unique_ptr<FieldSource> open_ohc(const std::filesystem::path& path, const ExternalField& description) {
    const std::vector<unsigned char> bytes = all_bytes(path);
    const OhcFile file = parse(path, bytes);
    if (description.values != ExternalField::Values::complex || description.phase_code)
        throw Error(ErrorCode::usage, "values",
                    fmt::format("'{}' states the meaning of its numbers; do not specify it", path.string()));
    ExternalField resolved = description;
    if (file.parts == Parts::amplitude) resolved.values = ExternalField::Values::amplitude;
    if (file.parts == Parts::phase) resolved.values = ExternalField::Values::phase;
    const Content content = file.parts == Parts::real_imaginary    ? Content::complex
                            : file.parts == Parts::amplitude_phase ? Content::amplitude_phase
                                                                   : Content::real;
    const SampleConverter convert(path, resolved, content, file.number, file.number);
    auto field = std::make_unique<Field>(external_grid(path, description, file.facts));
    const std::size_t samples = file.facts.width * file.facts.height, colours = file.facts.colours,
                      size = bytes_of(file.number);
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t index =
            file.side_by_side ? i * colours + description.colour : description.colour * samples + i;
        const auto number = [&](std::size_t element) {
            return number_at(file.number, &bytes[file.begin + element * size]);
        };
        field->samples.data()[i] = convert(number(index), file.two() ? number(index + samples * colours) : 0);
    }
    require_finite(*field, description.colour, path);
    return field;
}

}  // namespace hogel::io::arrays
