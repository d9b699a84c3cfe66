// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "hogel/error.h"
#include "hogel/image/formats/formats.h"

namespace hogel::image {

/// Joins the lines of a library's error message.
std::string one_line(std::string text);

/// Number of bytes at the beginning of a file that picture_reader() examines.
constexpr std::size_t beginning = 18;

using PictureReader = Picture (*)(const PictureBytes&);
/// Returns the reader for the format of a picture file, or null if the format is unknown.
PictureReader picture_reader(std::span<const unsigned char> bytes);

/// Converts exceptions of the libraries to Error(bad_input).
template <class Body>
auto guarded(const PictureBytes& file, const Body& body) {
    try {
        return body();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        file.fail("it needs more memory than is available");
    } catch (const std::exception& error) {
        file.fail(error.what());
    }
}

/// Throws Error(cannot_write). @param what  object of the message: "the picture 'x.png'"
[[noreturn]] void fail_write(const std::string& what, const std::string& why);

/// Converts exceptions of the encoders to Error(cannot_write); std::bad_alloc passes.
template <class Body>
auto guarded_write(const std::string& what, const Body& body) {
    try {
        return body();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail_write(what, error.what());
    }
}

/// Returns the bytes of a picture file. Reads the first 18 bytes before the rest, and throws Error(bad_input) if they
/// belong to no known format. Also throws Error(bad_input) for a missing file and for a file that is not regular.
/// @param file  name for error messages; its bytes are ignored
std::vector<unsigned char> bytes_of_file(const std::filesystem::path& path, const PictureBytes& file);

/// Reads a picture file as stored. Throws as read_image() does.
Picture read_picture(const std::filesystem::path& path, std::size_t max_pixels);

/// Return an error in the outer structure of a PNG or EXR file, or "". Needed because the libraries allocate the
/// claimed length of a chunk or attribute before they check the length of the file.
std::string png_structure_error(std::span<const unsigned char> bytes);
std::string exr_structure_error(std::span<const unsigned char> bytes);

}  // namespace hogel::image
