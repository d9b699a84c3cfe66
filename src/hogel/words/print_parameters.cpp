// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "hogel/requests.h"

namespace hogel {
namespace {

std::array<double, 3> doses_of(const std::string& text) {
    std::array<double, 3> doses{};
    std::istringstream words(text);
    std::string word;
    std::size_t count = 0;
    for (; std::getline(words, word, ','); ++count) {
        const std::optional<double> dose = parse_number(word);
        if (!dose || count >= 3) break;
        doses[count] = *dose;
    }
    if (count != 3 || words)
        throw Error(ErrorCode::usage, "dose", fmt::format("'{}' is not three numbers R,G,B such as 1,0.8,0.6", text));
    return doses;
}

// Reads numbers that are separated by white space.
std::vector<double> table_in(const std::string& file) {
    std::ifstream stream(file);
    std::vector<double> table;
    std::string word;
    constexpr std::size_t max_numbers = 65536;
    while (stream >> word && table.size() <= max_numbers) {
        const std::optional<double> number = parse_number(word);
        if (!number) throw Error(ErrorCode::usage, "table", fmt::format("{}: '{}' is not a number", file, word));
        table.push_back(*number);
    }
    if (table.size() < 2 || table.size() > max_numbers)
        throw Error(ErrorCode::usage, "table",
                    fmt::format("{}: expected 2 to {} numbers from 0 to 1, the samples of light from 0 to 1", file,
                                max_numbers));
    return table;
}

Array<float, 2> mask_in(const std::string& file) {
    RawPixels pixels = read_raw_pixels(file);
    if (pixels.levels > 0)
        for (float& value : pixels.values.elements()) value /= static_cast<float>(pixels.levels - 1);
    return std::move(pixels.values);
}

}  // namespace

PrinterImageOptions PrintParameters::options() const {
    PrinterImageOptions asked = images;
    asked.serpentine = order == "serpentine";
    asked.mirror_columns = mirror == "columns" || mirror == "both";
    asked.mirror_rows = mirror == "rows" || mirror == "both";
    asked.transfer = *transfer_named(transfer);
    asked.exposure = parse_exposure(exposure);
    asked.dose = doses_of(dose);
    asked.bits = static_cast<unsigned>(std::min<std::size_t>(bits, 99));  // write_printer_images() refuses them
    asked.circle = mask == "circle";
    if (!mask.empty() && !asked.circle) asked.mask = mask_in(mask);
    if (!table.empty()) asked.table = table_in(table);
    return asked;
}

void PrintParameters::declare(Parameters& parameters) {
    parameters.group("Pictures");
    parameters.flag("--strips", images.rows, "One picture per row of hogels, side by side, instead of one per hogel");
    parameters.choice(
        "--order", order, {"serpentine", "rows"}, "NAME",
        "Order of the hogels:\nserpentine: every second row from the right\nrows: all rows from the left");
    parameters.choice("--mirror", mirror, {"none", "columns", "rows", "both"}, "WHICH",
                      "Reverse the order of columns, rows or both of a hogel's picture");
    parameters.flag("--transpose", images.transpose,
                    "Exchange columns and rows of a hogel's picture, after --mirror; with rows it turns clockwise");
    parameters
        .text("--mask", mask, "circle|FILE",
              "Aperture of a hogel's picture: black outside the largest ellipse, or factors in a grey picture")
        .no_default();
    parameters.flag("--planes", images.planes, "Grey pictures of R, G and B instead of colours: hogel_0001_r.png");
    parameters.count("--bits", bits, "Bits of samples: 8 or 16");
    parameters
        .choice("--transfer", transfer, transfer_names(), "NAME",
                fmt::format("Transfer curve from light to samples: {}", fmt::join(transfer_names(), ", ")))
        .acts_if([this] { return table.empty(); });
    parameters
        .text("--table", table, "FILE",
              "Text file with samples, 0 to 1, for evenly spaced light from 0 to 1; instead of --transfer")
        .no_default()
        .excludes("--transfer");
    parameters.text("--exposure", exposure, "NUMBER|auto", "Factor for linear values, the same in all pictures");
    parameters.text("--dose", dose, "R,G,B", "Factors of the three colours in addition to the exposure");
}

}  // namespace hogel
