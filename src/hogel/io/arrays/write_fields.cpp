// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/core/lower_case.h"
#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/image/channels.h"
#include "hogel/io/arrays/mat_write.h"
#include "hogel/io/arrays/npy.h"
#include "hogel/io/arrays/zip.h"

namespace hogel {

using namespace io::arrays;

namespace {

using Complex = std::complex<float>;

// Returns [y][x], or [wavelength][y][x].
std::vector<std::size_t> shape_of(std::span<const Field> fields) {
    std::vector<std::size_t> shape{fields[0].grid().plane.height, fields[0].grid().plane.width};
    if (fields.size() > 1) shape.insert(shape.begin(), fields.size());
    return shape;
}

std::vector<unsigned char> npy_bytes(const std::string& type, std::span<const std::size_t> shape) {
    const std::string start = npy_beginning(type, shape);
    return {start.begin(), start.end()};
}

void append(std::vector<unsigned char>& to, const void* from, std::size_t bytes) {
    const auto* const first = static_cast<const unsigned char*>(from);
    to.insert(to.end(), first, first + bytes);
}

std::vector<double> wavelengths_of(std::span<const Field> fields) {
    std::vector<double> lengths;
    for (const Field& field : fields) lengths.push_back(field.grid().wavelength);
    return lengths;
}

void write_npy_file(const std::filesystem::path& path, std::span<const Field> fields) {
    const std::string start = npy_beginning("<c8", shape_of(fields));
    core::OutputFile output(path);
    core::RawFile file(output.temporary(), core::RawFile::Mode::create, path);
    file.write(0, start.data(), start.size());
    std::uint64_t offset = start.size();
    for (const Field& field : fields) {
        const std::size_t bytes = field.samples.size() * sizeof(Complex);
        file.write(offset, field.samples.data(), bytes);
        offset += bytes;
    }
    file.close();
    output.commit();
}

void write_npz_file(const std::filesystem::path& path, std::span<const Field> fields) {
    ZipWriter zip(path);
    std::vector<unsigned char> samples = npy_bytes("<c8", shape_of(fields));
    for (const Field& field : fields) append(samples, field.samples.data(), field.samples.size() * sizeof(Complex));
    zip.add("field.npy", samples);
    const auto add = [&](const char* name, const std::vector<double>& values) {
        const std::size_t shape[1] = {values.size()};
        std::vector<unsigned char> bytes =
            npy_bytes("<f8", values.size() == 1 ? std::span<const std::size_t>() : std::span(shape));
        append(bytes, values.data(), values.size() * sizeof(double));
        zip.add(fmt::format("{}.npy", name), bytes);
    };
    const Grid& plane = fields[0].grid().plane;
    if (plane.pitch_x == plane.pitch_y) {
        add("pitch", {plane.pitch_x});
    } else {
        add("pitch_x", {plane.pitch_x});
        add("pitch_y", {plane.pitch_y});
    }
    add("wavelength", wavelengths_of(fields));
    core::write_file(path, zip.finish());
}

void write_mat_file(const std::filesystem::path& path, std::span<const Field> fields, const Metadata& metadata) {
    const Grid& plane = fields[0].grid().plane;
    std::vector<float> real, imaginary;
    for (const Field& field : fields)
        for (std::size_t x = 0; x < plane.width; ++x) {
            core::throw_if_stopped();
            for (std::size_t y = 0; y < plane.height; ++y) {
                real.push_back(field.samples(y, x).real());
                imaginary.push_back(field.samples(y, x).imag());
            }
        }
    // MATLAB's axis order: rows, columns, wavelengths.
    std::vector<std::size_t> shape{plane.height, plane.width};
    if (fields.size() > 1) shape.push_back(fields.size());
    MatWriter writer(path);
    writer.array("field", shape, real, imaginary);
    if (plane.pitch_x == plane.pitch_y) {
        writer.numbers("pitch", std::vector{plane.pitch_x});
    } else {
        writer.numbers("pitch_x", std::vector{plane.pitch_x});
        writer.numbers("pitch_y", std::vector{plane.pitch_y});
    }
    writer.numbers("wavelength", wavelengths_of(fields));
    std::string history;
    for (const auto& [key, text] : metadata) history += fmt::format("{}: {}\n", key, text);
    if (!history.empty()) writer.text("history", history);
    core::write_file(path, writer.bytes());
}

void write_exr_file(const std::filesystem::path& path, std::span<const Field> fields, const Metadata& metadata) {
    const Grid& plane = fields[0].grid().plane;
    image::NamedChannels picture{{}, metadata};
    const ExternalField sampling{.pitch_x = plane.pitch_x, .pitch_y = plane.pitch_y};
    for (auto& entry : field_entries(sampling, wavelengths_of(fields))) picture.texts.push_back(std::move(entry));
    for (std::size_t c = 0; c < fields.size(); ++c) {
        Array<float, 2> real({plane.height, plane.width}), imaginary({plane.height, plane.width});
        for (std::size_t i = 0; i < real.size(); ++i) {
            real.data()[i] = fields[c].samples.data()[i].real();
            imaginary.data()[i] = fields[c].samples.data()[i].imag();
        }
        picture.channels.emplace_back(fmt::format("field{}.real", c), std::move(real));
        picture.channels.emplace_back(fmt::format("field{}.imaginary", c), std::move(imaginary));
    }
    image::write_named_channels(path, std::move(picture));
}

}  // namespace

void require_fields_name(const std::filesystem::path& path) {
    const std::string ending = core::lower_case_extension(path);
    for (const char* known : {".npy", ".npz", ".mat", ".exr"})
        if (ending == known) return;
    throw Error(ErrorCode::usage, fmt::format("'{}': fields are written as .npy, .npz, .mat or .exr", path.string()));
}

void write_fields(const std::filesystem::path& path, std::span<const Field> fields, const Metadata& metadata) {
    require_fields_name(path);
    if (fields.empty() ||
        std::ranges::any_of(fields, [&](const Field& field) { return field.grid().plane != fields[0].grid().plane; }))
        throw Error(ErrorCode::usage, fmt::format("'{}': fields of one sampling were expected", path.string()));
    const std::string ending = core::lower_case_extension(path);
    if (ending == ".npy") return write_npy_file(path, fields);
    if (ending == ".npz") return write_npz_file(path, fields);
    if (ending == ".mat") return write_mat_file(path, fields, metadata);
    write_exr_file(path, fields, metadata);
}

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
