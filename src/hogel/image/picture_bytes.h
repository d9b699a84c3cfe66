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

/// Puts an error message of a library on one line.
std::string one_line(std::string text);

/// How many of a file's first bytes picture_reader() looks at.
constexpr std::size_t beginning = 18;

using PictureReader = Picture (*)(const PictureBytes&);
/// The reader of the format that a picture file begins with; null for an unknown one.
PictureReader picture_reader(std::span<const unsigned char> bytes);

/// Turns what the libraries throw into Error(bad_input).
template <class Body>
auto guarded(const PictureBytes& file, const Body& body) {
    try {
        return body();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        file.fail("it needs more memory than there is");
    } catch (const std::exception& error) {
        file.fail(error.what());
    }
}

/// Throws Error(cannot_write). @param what  for the message: "the picture 'x.png'"
[[noreturn]] void fail_write(const std::string& what, const std::string& why);

/// Turns what the libraries throw while they encode `what` into Error(cannot_write); std::bad_alloc passes.
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

/// The bytes of a picture file of `file`, whose own bytes are not looked at. Throws Error(bad_input) for a file that is
/// missing, is no plain file, or begins as no picture does; the rest of such a file is not read.
std::vector<unsigned char> bytes_of_file(const std::filesystem::path& path, const PictureBytes& file);

/// Reads a picture file as it is stored. Throws as read_image() does.
Picture read_picture(const std::filesystem::path& path, std::size_t max_pixels);

/// Describe what is wrong with the outer structure of a PNG or EXR file; "" if nothing is. The check is needed because
/// the libraries that read these files allocate the length that a chunk or an attribute claims before they know whether
/// the file is that long.
std::string png_structure_error(std::span<const unsigned char> bytes);
std::string exr_structure_error(std::span<const unsigned char> bytes);

}  // namespace hogel::image
