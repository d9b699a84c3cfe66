// SPDX-License-Identifier: Apache-2.0
// NumPy's array format, versions 1 to 3: "\x93NUMPY", two version bytes, the header length (2 bytes, 4 since version
// 2), the header as text of a Python dictionary, and the numbers.
#include "hogel/io/arrays/npy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <vector>

#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/io/arrays/named_arrays.h"

namespace hogel::io::arrays {
namespace {

constexpr std::array<unsigned char, 6> magic{0x93, 'N', 'U', 'M', 'P', 'Y'};
constexpr std::size_t max_header = 1 << 16;

constexpr std::size_t max_axes = 32;  // as in NumPy

// Returns the text after "'key':", or nothing.
std::string_view value_of(std::string_view header, const char* key) {
    const std::string quoted = fmt::format("'{}'", key);
    std::size_t position = header.find(quoted);
    if (position == std::string_view::npos) return {};
    position = header.find_first_not_of(" \t\n", position + quoted.size());
    if (position == std::string_view::npos || header[position] != ':') return {};
    position = header.find_first_not_of(" \t\n", position + 1);
    return position == std::string_view::npos ? std::string_view{} : header.substr(position);
}

// Parses an integer at the start of a text. Returns false if there is none below 2^40.
bool take_number(std::string_view& text, std::size_t& number) {
    number = 0;
    std::size_t digits = 0;
    while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9' && number < std::size_t{1} << 40)
        number = 10 * number + static_cast<std::size_t>(text[digits++] - '0');
    text.remove_prefix(digits);
    return digits > 0 && number < std::size_t{1} << 40;
}

bool take(std::string_view& text, char expected) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    if (text.empty() || text.front() != expected) return false;
    text.remove_prefix(1);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    return true;
}

// Returns false for unsupported types.
bool take_type(std::string_view descr, NpyHeader& header) {
    struct Known {
        std::string_view name;
        Number number;
        bool complex;
    };
    static constexpr Known known[] = {
        {"c8'", Number::single, true},   {"c16'", Number::real, true},   {"f2'", Number::half, false},
        {"f4'", Number::single, false},  {"f8'", Number::real, false},   {"u1'", Number::uint8, false},
        {"b1'", Number::boolean, false}, {"i1'", Number::int8, false},   {"u2'", Number::uint16, false},
        {"i2'", Number::int16, false},   {"u4'", Number::uint32, false}, {"i4'", Number::int32, false},
        {"u8'", Number::uint64, false},  {"i8'", Number::int64, false},
    };
    // The first letter is the byte order.
    for (const Known& type : known) {
        const std::string_view orders = bytes_of(type.number) == 1 ? "|" : "<>";
        if (descr.size() > 2 && descr[0] == '\'' && orders.find(descr[1]) != orders.npos &&
            descr.substr(2).starts_with(type.name)) {
            header.number = type.number;
            header.complex = type.complex;
            header.big_endian = descr[1] == '>';
            return true;
        }
    }
    return false;
}

[[noreturn]] void fail_type(const std::filesystem::path& path, std::string_view descr) {
    std::string shown(descr.substr(0, std::min<std::size_t>(descr.find(','), 12)));
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
    fail_external(path,
                  fmt::format("its numbers are of type {}; c8, c16, f2, f4, f8 and whole numbers are read", shown));
}

// Parses the extents of "(4, 3)". Returns false for anything else.
bool parse_shape(std::string_view text, std::vector<std::size_t>& shape) {
    if (!take(text, '(')) return false;
    for (std::size_t extent = 0; take_number(text, extent);) {
        shape.push_back(extent);
        if (!take(text, ',')) break;
    }
    return shape.size() <= max_axes && take(text, ')');
}

void require_numbers(const std::filesystem::path& path, std::uint64_t size, const NpyHeader& header) {
    const std::uint64_t bytes = header.bytes_of_sample();
    std::uint64_t remaining = (size - header.begin) / bytes;
    for (const std::size_t extent : header.shape) remaining = extent == 0 ? remaining : remaining / extent;
    if (remaining == 0 && std::ranges::count(header.shape, 0u) == 0)
        fail_external(path, fmt::format("it is truncated: {} bytes are too few for {} numbers of {} bytes",
                                        size - header.begin, fmt::join(header.shape, "x"), bytes));
}

// Returns the text of the header; sets the offset of the numbers.
std::string text_of(const std::filesystem::path& path, std::span<const unsigned char> start, std::uint64_t& begin) {
    if (start.size() < 12) fail_external(path, "it is truncated inside its header");
    const int version = start[6];
    if (version < 1 || version > 3) fail_external(path, fmt::format("its NPY version {} is not known", version));
    std::size_t length = start[8] + 256u * start[9];
    begin = 10;
    if (version > 1) {
        length += (std::size_t{start[10]} << 16) + (std::size_t{start[11]} << 24);
        begin = 12;
    }
    if (length > max_header || begin + length > start.size())
        fail_external(path, fmt::format("its header of {} bytes is damaged", length));
    const std::string text(reinterpret_cast<const char*>(&start[begin]), length);
    begin += length;
    return text;
}

}  // namespace

bool npy_holds_numbers(const std::filesystem::path& path, std::span<const unsigned char> start) {
    NpyHeader header;
    return take_type(value_of(text_of(path, start, header.begin), "descr"), header);
}

NpyHeader parse_npy_header(const std::filesystem::path& path, std::span<const unsigned char> start,
                           std::uint64_t size) {
    NpyHeader header;
    const std::string text = text_of(path, start, header.begin);
    if (!take_type(value_of(text, "descr"), header)) fail_type(path, value_of(text, "descr"));
    const std::string_view order = value_of(text, "fortran_order");
    header.by_columns = order.starts_with("True");
    if (!parse_shape(value_of(text, "shape"), header.shape) || (!header.by_columns && !order.starts_with("False")))
        fail_external(path, "its header does not state the array's shape and order");
    require_numbers(path, size, header);
    return header;
}

NpyHeader read_npy_header(const std::filesystem::path& path, const core::RawFile& file) {
    std::vector<unsigned char> start(std::min<std::uint64_t>(file.size(), npy_start));
    file.read(0, start.data(), start.size());
    return parse_npy_header(path, start, file.size());
}

std::string npy_beginning(const std::string& type, std::span<const std::size_t> shape) {
    const std::string extents = fmt::format("{}{}", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, extents);
    header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 10 - 1, ' ');
    header += '\n';
    std::string start(magic.begin(), magic.end());
    start += {1, 0, static_cast<char>(header.size() % 256), static_cast<char>(header.size() / 256)};
    return start + header;
}

namespace {

ExternalFacts facts_of(const NpyHeader& header, const Planes& planes) {
    ExternalFacts facts;
    facts.format = "npy";
    facts.numbers = fmt::format("{}, {}{}",
                                header.complex         ? "complex"
                                : planes.step_pair > 0 ? "pairs of real numbers"
                                                       : "real",
                                header.number == Number::boolean  ? "0 or 1"
                                : header.number == Number::half   ? "half floats"
                                : header.number == Number::single ? "single floats"
                                : header.number == Number::real
                                    ? "double floats"
                                    : fmt::format("whole numbers of {} bits", 8 * bytes_of(header.number)),
                                header.big_endian ? ", big-endian" : "");
    facts.width = planes.width;
    facts.height = planes.height;
    facts.colours = planes.colours;
    return facts;
}

class NpyField final : public FieldSource {
  public:
    NpyField(const std::filesystem::path& path, const ExternalField& description)
        : file_(path, core::RawFile::Mode::read, path),
          header_(read_npy_header(path, file_)),
          planes_(planes_of(path, header_.shape, header_.by_columns, header_.complex)),
          grid_(external_grid(path, description, facts_of(header_, planes_))),
          colour_(description.colour),
          convert_(converter(path, description)) {}

    const FieldGrid& grid() const override { return grid_; }

    // Reads lines along the axis with the smaller stride.
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        validate(region, grid_, out.shape());
        if (look != 0) throw Error(ErrorCode::usage, fmt::format("look {} was asked of a file, which has one", look));
        const std::size_t number_bytes = bytes_of(header_.number), bytes = header_.bytes_of_sample();
        const bool columns = planes_.step_y < planes_.step_x;
        const std::size_t lines = columns ? region.width : region.height,
                          count = columns ? region.height : region.width,
                          step = columns ? planes_.step_y : planes_.step_x;
        // The second real number of each sample is read as another line, which may be the same in the file.
        std::vector<unsigned char> line(((count - 1) * step + 1) * bytes),
            second(planes_.step_pair > 0 ? line.size() : 0);
        for (std::size_t i = 0; i < lines; ++i) {
            const std::size_t x = region.x0 + (columns ? i : 0), y = region.y0 + (columns ? 0 : i);
            const std::size_t first = y * planes_.step_y + x * planes_.step_x + colour_ * planes_.step_colour;
            read_numbers(first, line);
            if (!second.empty()) read_numbers(first + planes_.step_pair, second);
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t offset = k * step * bytes;
                const double second_number = !second.empty()   ? number_at(header_.number, &second[offset])
                                             : header_.complex ? number_at(header_.number, &line[offset + number_bytes])
                                                               : 0;
                (columns ? out(k, i) : out(i, k)) = convert_(number_at(header_.number, &line[offset]), second_number);
            }
        }
        require_finite(out, region, colour_, file_.name());
    }

  private:
    SampleConverter converter(const std::filesystem::path& path, ExternalField description) const {
        const Content content = header_.complex         ? Content::complex
                                : planes_.step_pair > 0 ? take_pairs(path, description)
                                                        : Content::real;
        return {path, description, content, header_.number, header_.number};
    }

    // Converts to native byte order.
    void read_numbers(std::size_t first, std::vector<unsigned char>& bytes) const {
        file_.read(header_.begin + first * header_.bytes_of_sample(), bytes.data(), bytes.size());
        const std::size_t number = bytes_of(header_.number);
        if (header_.big_endian)
            for (std::size_t offset = 0; offset < bytes.size(); offset += number)
                std::reverse(&bytes[offset], &bytes[offset] + number);
    }

    core::RawFile file_;
    NpyHeader header_;
    Planes planes_;
    FieldGrid grid_;
    std::size_t colour_;
    SampleConverter convert_;
};

}  // namespace

bool is_npy(std::span<const unsigned char> start) {
    return start.size() >= magic.size() && std::equal(magic.begin(), magic.end(), start.begin());
}

ExternalFacts npy_facts(const std::filesystem::path& path) {
    const NpyHeader header = read_npy_header(path, core::RawFile(path, core::RawFile::Mode::read, path));
    return facts_of(header, planes_of(path, header.shape, header.by_columns, header.complex));
}

std::unique_ptr<FieldSource> open_npy(const std::filesystem::path& path, const ExternalField& description) {
    return std::make_unique<NpyField>(path, description);
}

}  // namespace hogel::io::arrays
