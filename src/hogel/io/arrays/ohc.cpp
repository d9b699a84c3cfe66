// SPDX-License-Identifier: Apache-2.0
// Complex fields of OpenHolo, without padding between members and little-endian: a head of 24 bytes ("OH", size of the
// file, version, the address of the samples), a head of the field of 65 bytes, the wavelengths as doubles, and the
// samples: all real parts or amplitudes, then all imaginary parts or phases, each by rows, with the wavelengths side by
// side in a sample or one after the other.
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
    bool side_by_side = false;  // whether the wavelengths of a sample are
    std::uint64_t begin = 0;    // of the samples

    bool two() const { return parts == Parts::amplitude_phase || parts == Parts::real_imaginary; }
};

template <class T>
T value_at(std::span<const unsigned char> bytes, std::size_t at) {
    T value;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
}

// Metres; files that leave the unit out are in metres too.
double unit_of(const std::filesystem::path& path, unsigned char unit) {
    constexpr std::array<double, 6> metres{1, 1, 1e-2, 1e-3, 1e-6, 1e-9};
    if (unit >= metres.size()) fail_external(path, fmt::format("its unit of length {} is not known", unit));
    return metres[unit];
}

void read_kinds(const std::filesystem::path& path, std::span<const unsigned char> head, OhcFile& file) {
    constexpr unsigned char each_colour = 2, singles = 9, doubles = 10, directly = 1, last_kind = 4;
    // From 33 on: colour type, colour arrangement, unit of wavelengths, type of numbers, way of storing, parts.
    const unsigned char arrangement = head[34], type = head[36], stored = head[37], parts = head[38];
    if (type != singles && type != doubles)
        fail_external(path, fmt::format("its numbers are of type {}; single and double floats are read", type));
    if (stored > directly) fail_external(path, "its samples are in other files, which are not read");
    if (parts == 0 || parts > last_kind)
        fail_external(path, fmt::format("its way to store fields, {}, is not known", parts));
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
    std::uint64_t held = (bytes.size() - file.begin) / bytes_of(file.number) / (file.two() ? 2 : 1) / facts.colours;
    if (facts.width > 0 && facts.height > 0 && held / facts.width / facts.height == 0)
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
    // "OH" alone begins other files too; so do the reserved zeros and the version.
    return start.size() >= file_head + field_head && start[0] == 'O' && start[1] == 'H' &&
           value_at<std::uint32_t>(start, 12) == 0 && value_at<std::uint32_t>(start, 16) == 0;
}

ExternalFacts ohc_facts(const std::filesystem::path& path) { return parse(path, all_bytes(path)).facts; }

std::unique_ptr<FieldSource> open_ohc(const std::filesystem::path& path, const ExternalField& what) {
    const std::vector<unsigned char> bytes = all_bytes(path);
    const OhcFile file = parse(path, bytes);
    if (what.values != ExternalField::Values::complex || what.phase_code)
        throw Error(ErrorCode::usage, "values", fmt::format("'{}' says itself what its numbers are", path.string()));
    ExternalField meant = what;
    if (file.parts == Parts::amplitude) meant.values = ExternalField::Values::amplitude;
    if (file.parts == Parts::phase) meant.values = ExternalField::Values::phase;
    const Content content = file.parts == Parts::real_imaginary    ? Content::complex
                            : file.parts == Parts::amplitude_phase ? Content::amplitude_phase
                                                                   : Content::real;
    const SampleConverter convert(path, meant, content, file.number, file.number);
    auto field = std::make_unique<Field>(external_grid(path, what, file.facts));
    const std::size_t samples = file.facts.width * file.facts.height, colours = file.facts.colours,
                      size = bytes_of(file.number);
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t at = file.side_by_side ? i * colours + what.colour : what.colour * samples + i;
        const auto number = [&](std::size_t index) {
            return number_at(file.number, &bytes[file.begin + index * size]);
        };
        field->samples.data()[i] = convert(number(at), file.two() ? number(at + samples * colours) : 0);
    }
    require_finite(*field, what.colour, path);
    return field;
}

}  // namespace hogel::io::arrays
