// SPDX-License-Identifier: Apache-2.0
// NumPy's array format, versions 1 to 3: "\x93NUMPY", two bytes of version, the length of a header (2 bytes, or 4 from
// version 2 on), the header as the text of a Python dictionary, and the numbers.
#include "hogel/io/arrays/npy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <vector>

#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"

namespace hogel::io::arrays {
namespace {

constexpr std::array<unsigned char, 6> magic{0x93, 'N', 'U', 'M', 'P', 'Y'};
constexpr std::size_t max_header = 1 << 16;

constexpr std::size_t max_axes = 32;  // as in NumPy

// The text after "'key':", or nothing.
std::string_view value_of(std::string_view header, const char* key) {
    const std::string quoted = fmt::format("'{}'", key);
    std::size_t at = header.find(quoted);
    if (at == std::string_view::npos) return {};
    at = header.find_first_not_of(" \t\n", at + quoted.size());
    if (at == std::string_view::npos || header[at] != ':') return {};
    at = header.find_first_not_of(" \t\n", at + 1);
    return at == std::string_view::npos ? std::string_view{} : header.substr(at);
}

// Reads a whole number from the start of a text. Returns false if there is none below 2^40.
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

void parse_type(const std::filesystem::path& path, std::string_view descr, NpyHeader& header) {
    struct Known {
        std::string_view name;
        Number number;
        bool complex;
    };
    static constexpr Known known[] = {
        {"c8'", Number::single, true},  {"c16'", Number::real, true},   {"f2'", Number::half, false},
        {"f4'", Number::single, false}, {"f8'", Number::real, false},   {"u1'", Number::uint8, false},
        {"i1'", Number::int8, false},   {"u2'", Number::uint16, false}, {"i2'", Number::int16, false},
        {"u4'", Number::uint32, false}, {"i4'", Number::int32, false},  {"u8'", Number::uint64, false},
        {"i8'", Number::int64, false},
    };
    // The first letter is the order of bytes.
    for (const Known& type : known) {
        const std::string_view orders = bytes_of(type.number) == 1 ? "|" : "<>";
        if (descr.size() > 2 && descr[0] == '\'' && orders.find(descr[1]) != orders.npos &&
            descr.substr(2).starts_with(type.name)) {
            header.number = type.number;
            header.complex = type.complex;
            header.big_endian = descr[1] == '>';
            return;
        }
    }
    std::string shown(descr.substr(0, std::min<std::size_t>(descr.find(','), 12)));
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
    fail_external(path,
                  fmt::format("its numbers are of type {}; c8, c16, f2, f4, f8 and whole numbers are read", shown));
}

// The extents of "(4, 3)". Returns false for anything else.
bool parse_shape(std::string_view text, std::vector<std::size_t>& shape) {
    if (!take(text, '(')) return false;
    for (std::size_t extent = 0; take_number(text, extent);) {
        shape.push_back(extent);
        if (!take(text, ',')) break;
    }
    return shape.size() <= max_axes && take(text, ')');
}

// Throws unless all numbers are in the file.
void require_numbers(const std::filesystem::path& path, const core::RawFile& file, const NpyHeader& header) {
    const std::uint64_t bytes = header.bytes_of_sample();
    std::uint64_t held = (file.size() - header.begin) / bytes;
    for (const std::size_t extent : header.shape) held = extent == 0 ? held : held / extent;
    if (held == 0 && std::ranges::count(header.shape, 0u) == 0)
        fail_external(path, fmt::format("it is truncated: {} bytes are too few for {} numbers of {} bytes",
                                        file.size() - header.begin, fmt::join(header.shape, "x"), bytes));
}

}  // namespace

NpyHeader read_npy_header(const std::filesystem::path& path, const core::RawFile& file) {
    std::array<unsigned char, 12> start{};
    file.read(0, start.data(), 10);
    const int version = start[6];
    if (version < 1 || version > 3) fail_external(path, fmt::format("its NPY version {} is not known", version));
    NpyHeader header;
    std::size_t length = start[8] + 256u * start[9];
    header.begin = 10;
    if (version > 1) {
        file.read(10, &start[10], 2);
        length += (std::size_t{start[10]} << 16) + (std::size_t{start[11]} << 24);
        header.begin = 12;
    }
    if (length > max_header || header.begin + length > file.size())
        fail_external(path, fmt::format("its header of {} bytes is damaged", length));
    std::string text(length, '\0');
    file.read(header.begin, text.data(), length);
    header.begin += length;

    parse_type(path, value_of(text, "descr"), header);
    const std::string_view order = value_of(text, "fortran_order");
    header.by_columns = order.starts_with("True");
    if (!parse_shape(value_of(text, "shape"), header.shape) || (!header.by_columns && !order.starts_with("False")))
        fail_external(path, "its header says nothing of the array's shape or order");
    require_numbers(path, file, header);
    return header;
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

// A field, or three, in an array.
struct Planes {
    std::size_t height = 0, width = 0, colours = 1;
    bool colours_last = false;  // [row][column][colour] instead of [colour][row][column]
};

// One or three numbers in front of rows and columns, or else behind them, are colours.
Planes planes_of(const std::filesystem::path& path, const NpyHeader& header) {
    std::vector<std::size_t> axes = header.shape;
    Planes planes;
    const auto is_colours = [](std::size_t extent) { return extent == 1 || extent == 3; };
    if (axes.size() == 3 && (is_colours(axes.front()) || is_colours(axes.back()))) {
        planes.colours_last = !is_colours(axes.front());
        const auto colours = planes.colours_last ? axes.end() - 1 : axes.begin();
        planes.colours = *colours;
        axes.erase(colours);
    }
    if (axes.size() != 2)
        fail_external(path,
                      "an array of two axes, [row][column], or of three with three colours first or last was expected");
    if (header.by_columns && planes.colours > 1)
        fail_external(path, "colours in an array by columns are not read; an array in C order was expected");
    planes.height = axes[0];
    planes.width = axes[1];
    return planes;
}

class NpyField final : public FieldSource {
  public:
    NpyField(const std::filesystem::path& path, const ExternalField& what)
        : file_(path, core::RawFile::Mode::read, path),
          header_(read_npy_header(path, file_)),
          planes_(planes_of(path, header_)),
          grid_(external_grid(path, what, planes_.width, planes_.height)),
          colour_(what.colour),
          convert_(path, what, header_.number, header_.complex) {
        if (colour_ >= planes_.colours)
            throw Error(ErrorCode::usage, fmt::format("'{}' has no colour {}: it holds {}", path.string(), colour_,
                                                      planes_.colours == 1 ? "one field" : "three fields"));
    }

    const FieldGrid& grid() const override { return grid_; }

    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        validate(region, grid_, out.shape());
        if (look != 0) throw Error(ErrorCode::usage, fmt::format("look {} was asked of a file, which has one", look));
        const std::size_t number_bytes = bytes_of(header_.number), bytes = header_.bytes_of_sample();
        const bool columns = header_.by_columns;
        const std::size_t lines = columns ? region.width : region.height,
                          count = columns ? region.height : region.width;
        // From a sample to the next one of a line, and to the first of this colour.
        const std::size_t step = planes_.colours_last ? planes_.colours : 1;
        const std::size_t colour = planes_.colours_last ? colour_ : colour_ * planes_.height * planes_.width;
        std::vector<unsigned char> line(((count - 1) * step + 1) * bytes);
        for (std::size_t i = 0; i < lines; ++i) {
            const std::size_t first =
                columns ? (region.x0 + i) * planes_.height + region.y0 : (region.y0 + i) * planes_.width + region.x0;
            file_.read(header_.begin + (first * step + colour) * bytes, line.data(), line.size());
            if (header_.big_endian)
                for (std::size_t at = 0; at < line.size(); at += number_bytes)
                    std::reverse(&line[at], &line[at] + number_bytes);
            for (std::size_t k = 0; k < count; ++k) {
                const unsigned char* at = &line[k * step * bytes];
                (columns ? out(k, i) : out(i, k)) = convert_(
                    number_at(header_.number, at), header_.complex ? number_at(header_.number, at + number_bytes) : 0);
            }
        }
    }

  private:
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

std::size_t npy_colours(const std::filesystem::path& path) {
    const NpyHeader header = read_npy_header(path, core::RawFile(path, core::RawFile::Mode::read, path));
    return planes_of(path, header).colours;
}

std::unique_ptr<FieldSource> open_npy(const std::filesystem::path& path, const ExternalField& what) {
    return std::make_unique<NpyField>(path, what);
}

}  // namespace hogel::io::arrays

namespace hogel {

using namespace io::arrays;

void write_npy(const std::filesystem::path& path, View<const std::complex<float>, 2> samples) {
    const std::string start = npy_beginning("<c8", samples.shape());
    core::OutputFile output(path);
    core::RawFile file(output.temporary(), core::RawFile::Mode::create, path);
    file.write(0, start.data(), start.size());
    file.write(start.size(), samples.data(), samples.size() * sizeof(std::complex<float>));
    file.close();
    output.commit();
}

}  // namespace hogel
