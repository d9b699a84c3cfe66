// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

namespace hogel {

/// A point or direction in the frame of docs/notation.md: x right, y up, z towards the viewer; metres.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
    friend Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
    friend Vec3 operator*(Vec3 a, double k) { return k * a; }
    friend Vec3 operator/(Vec3 a, double k) { return {a.x / k, a.y / k, a.z / k}; }
    Vec3& operator+=(Vec3 b) { return *this = *this + b; }
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(Vec3 a) { return a / length(a); }

/// A linear colour or another RGB triple.
struct Rgb {
    float r = 0, g = 0, b = 0;

    friend Rgb operator+(Rgb a, Rgb c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
    friend Rgb operator*(Rgb a, Rgb c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
    friend Rgb operator*(float k, Rgb a) { return {k * a.r, k * a.g, k * a.b}; }
    Rgb& operator+=(Rgb c) { return *this = *this + c; }
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Positions of samples on a plane parallel to the hologram, as the viewer sees them: column 0 at the left, row 0 at
/// the top. x(), y(), column() and row() convert between indices and metres.
struct Grid {
    std::size_t width = 0;   ///< samples in x
    std::size_t height = 0;  ///< samples in y
    double pitch_x = 0;      ///< metres between columns
    double pitch_y = 0;      ///< metres between rows
    double center_x = 0;     ///< x of the centre of the grid, metres
    double center_y = 0;     ///< y of the centre, metres

    double x(double column) const { return center_x + (column + 0.5 - 0.5 * static_cast<double>(width)) * pitch_x; }
    double y(double row) const { return center_y + (0.5 * static_cast<double>(height) - row - 0.5) * pitch_y; }
    double column(double x) const { return (x - center_x) / pitch_x + 0.5 * static_cast<double>(width) - 0.5; }
    double row(double y) const { return 0.5 * static_cast<double>(height) - 0.5 - (y - center_y) / pitch_y; }
    double size_x() const { return static_cast<double>(width) * pitch_x; }
    double size_y() const { return static_cast<double>(height) * pitch_y; }
    std::size_t samples() const { return width * height; }
    friend bool operator==(const Grid&, const Grid&) = default;
};

/// A rectangle of the samples of a Grid.
struct Region {
    std::size_t x0 = 0, y0 = 0;  ///< first column and row
    std::size_t width = 0, height = 0;

    std::size_t samples() const { return width * height; }
    friend bool operator==(const Region&, const Region&) = default;
};

/// Returns the grid of the samples of a region, at the same positions.
inline Grid part(const Grid& grid, const Region& region) {
    const double middle_column = static_cast<double>(region.x0) + 0.5 * static_cast<double>(region.width) - 0.5;
    const double middle_row = static_cast<double>(region.y0) + 0.5 * static_cast<double>(region.height) - 0.5;
    return {region.width, region.height, grid.pitch_x, grid.pitch_y, grid.x(middle_column), grid.y(middle_row)};
}

/// A rectangle in a plane, metres. Points on the left and lower edges belong to it, points on the other edges do not.
struct Rectangle {
    double left = 0, right = 0, bottom = 0, top = 0;

    explicit Rectangle(const Grid& plane)
        : left(plane.center_x - 0.5 * plane.size_x()),
          right(plane.center_x + 0.5 * plane.size_x()),
          bottom(plane.center_y - 0.5 * plane.size_y()),
          top(plane.center_y + 0.5 * plane.size_y()) {}
    bool holds(double x, double y) const { return x >= left && x < right && y >= bottom && y < top; }
    bool meets(const Rectangle& other) const {
        return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
    }
};

}  // namespace hogel
