// SPDX-License-Identifier: Apache-2.0
// Surfaces of depth maps.
#include <algorithm>
#include <array>
#include <cmath>

#include "hogel/core/stop_scope.h"
#include "hogel/scene/pictures.h"

namespace hogel::scene {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

/// Width of a continuation behind a step of nearness 1, as a fraction of the grid's width. In the default depth range
/// it is enough for directions up to 18 degrees from the axis.
constexpr float continuation_share = 1.0f / 12;

/// Distance of a continuation behind the surface that it continues, so that the surface hides their overlap of a pixel.
constexpr float continuation_lag = edge_step / 10;

bool are_joined(float a, float b) { return std::abs(a - b) <= edge_step; }

/// Builds a mesh corner by corner. Pixels around a corner are numbered from the top left, clockwise.
class ReliefMesh {
  public:
    ReliefMesh(const Relief& relief, double height) : relief_(relief), height_(height) {
        corners_.assign(relief.width * relief.height, {none, none, none, none});
        mesh_.name = "picture";
    }

    Mesh build() && {
        for (std::size_t y = 0; y <= relief_.height; ++y) {
            core::throw_if_stopped();
            for (std::size_t x = 0; x <= relief_.width; ++x) add_corner(x, y);
        }
        // A pixel's corners from its top left, clockwise.
        for (const auto& [top_left, top_right, bottom_right, bottom_left] : corners_) {
            if (top_left == none) continue;
            mesh_.triangles.push_back({top_left, bottom_left, bottom_right});
            mesh_.triangles.push_back({top_left, bottom_right, top_right});
        }
        return std::move(mesh_);
    }

  private:
    static constexpr std::size_t outside = ~std::size_t{0};

    /// Returns the pixels around a corner; `outside` for those without a surface.
    std::array<std::size_t, 4> pixels_around(std::size_t x, std::size_t y) const {
        std::array<std::size_t, 4> pixels{};
        constexpr std::array<std::array<std::size_t, 2>, 4> offsets{{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t column = x - offsets[i][0], row = y - offsets[i][1];  // wraps around beyond the edge
            const std::size_t pixel = row * relief_.width + column;
            const bool is_inside = column < relief_.width && row < relief_.height;
            pixels[i] = is_inside && (relief_.is_present.empty() || relief_.is_present[pixel] != 0) ? pixel : outside;
        }
        return pixels;
    }

    /// Adds one vertex for each surface at a corner: for each chain of joined neighbours.
    void add_corner(std::size_t x, std::size_t y) {
        const std::array<std::size_t, 4> pixels = pixels_around(x, y);
        const auto follows = [&](std::size_t i) {  // whether pixel i belongs to the surface of pixel i − 1
            const std::size_t a = pixels[(i + 3) % 4], b = pixels[i % 4];
            return a != outside && b != outside && are_joined(relief_.nearness[a], relief_.nearness[b]);
        };
        std::size_t first = 0;  // a pixel that begins a surface; if all are joined, any
        while (first < 4 && follows(first)) ++first;
        for (std::size_t i = first % 4, visited = 0; visited < 4;) {
            std::size_t count = 1;
            while (visited + count < 4 && follows(i + count)) ++count;
            if (pixels[i % 4] != outside) add_vertex(x, y, pixels, i, count);
            i += count;
            visited += count;
        }
    }

    void add_vertex(std::size_t x, std::size_t y, const std::array<std::size_t, 4>& pixels, std::size_t first,
                    std::size_t count) {
        const auto vertex = static_cast<std::uint32_t>(mesh_.positions.size());
        float sum = 0, column = 0, row = 0;
        Rgb color;
        for (std::size_t i = first; i < first + count; ++i) {
            const std::size_t pixel = pixels[i % 4];
            sum += relief_.nearness[pixel];
            const std::size_t pixel_x = pixel % relief_.width, pixel_y = pixel / relief_.width;
            column += static_cast<float>(pixel_x) + 0.5f;
            row += static_cast<float>(pixel_y) + 0.5f;
            if (!relief_.colors.empty()) color += relief_.colors[pixel];
            corners_[pixel][(i + 2) % 4] = vertex;  // the corner opposite to the pixel's place around it
        }
        const float share = 1 / static_cast<float>(count);
        const double u = static_cast<double>(x) / static_cast<double>(relief_.width),
                     v = 1 - static_cast<double>(y) / static_cast<double>(relief_.height);
        mesh_.positions.push_back({u - 0.5, (v - 0.5) * height_, double{share * sum}});
        mesh_.radiance.push_back(relief_.colors.empty() ? Rgb{1, 1, 1} : share * color);
        if (relief_.colors.empty()) mesh_.texture_coordinates.push_back(texel(x, y, share * column, share * row));
    }

    /// Returns a corner's point of the texture: the mean centre of the pixels of its surface, so that interpolation at
    /// an edge takes no colour of another surface. The border of the picture is that of the texture.
    TextureCoordinate texel(std::size_t x, std::size_t y, float column, float row) const {
        const auto width = static_cast<float>(relief_.width), height = static_cast<float>(relief_.height);
        if (x == 0 || x == relief_.width) column = static_cast<float>(x);
        if (y == 0 || y == relief_.height) row = static_cast<float>(y);
        return {column / width, 1 - row / height};
    }

    const Relief& relief_;
    double height_;
    std::vector<std::array<std::uint32_t, 4>> corners_;
    Mesh mesh_;
};

/// A picture's mean colour over pixels of a coarser or finer grid.
class GridColors {
  public:
    GridColors(const Image& picture, const Relief& grid) : picture_(picture), grid_(grid) {}

    Rgb operator()(std::size_t pixel) const {
        const std::size_t x = pixel % grid_.width, y = pixel / grid_.width;
        const std::size_t left = x * picture_.width() / grid_.width, top = y * picture_.height() / grid_.height;
        const std::size_t right = std::max(left + 1, (x + 1) * picture_.width() / grid_.width),
                          bottom = std::max(top + 1, (y + 1) * picture_.height() / grid_.height);
        Rgb sum;
        for (std::size_t row = top; row < bottom; ++row)
            for (std::size_t column = left; column < right; ++column) {
                const float* texel = &picture_.pixels(row, column, 0);
                sum += picture_.channels() < 3 ? Rgb{texel[0], texel[0], texel[0]} : Rgb{texel[0], texel[1], texel[2]};
            }
        return 1 / static_cast<float>((right - left) * (bottom - top)) * sum;
    }

  private:
    const Image& picture_;
    const Relief& grid_;
};

/// Grows continuations ring by ring, away from the edges.
class Continuation {
  public:
    Continuation(const Relief& front, const Image& picture) : front_(front), color_of_(picture, front) {
        behind_.width = front.width;
        behind_.height = front.height;
        const std::size_t pixels = front.width * front.height;
        behind_.nearness.resize(pixels);
        behind_.is_present.resize(pixels);
        behind_.colors.resize(pixels);
    }

    Relief build() && {
        std::vector<std::size_t> ring = first_ring();
        for (std::size_t number = 1; !ring.empty(); ++number) {
            core::throw_if_stopped();
            ring = next_ring(ring, number);
        }
        const std::size_t pixels = front_.nearness.size();
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            float& nearness = behind_.nearness[pixel];
            nearness = std::max(nearness - continuation_lag, 0.0f);
            // No overlap at the farthest depth: the lag would extend the range.
            if (front_.nearness[pixel] < continuation_lag) behind_.is_present[pixel] = 0;
        }
        return std::move(behind_);
    }

  private:
    /// Calls a function with the neighbours of a pixel, and with the step from the pixel to each.
    template <class Function>
    void for_neighbors(std::size_t pixel, bool diagonals, const Function& function) const {
        const auto x = static_cast<std::ptrdiff_t>(pixel % front_.width),
                   y = static_cast<std::ptrdiff_t>(pixel / front_.width);
        for (std::ptrdiff_t down = -1; down <= 1; ++down)
            for (std::ptrdiff_t right = -1; right <= 1; ++right) {
                if ((right == 0 && down == 0) || (!diagonals && right != 0 && down != 0)) continue;
                if (is_inside(x + right, y + down)) function(at(x + right, y + down), right, down);
            }
    }
    bool is_inside(std::ptrdiff_t x, std::ptrdiff_t y) const {
        return x >= 0 && y >= 0 && x < static_cast<std::ptrdiff_t>(front_.width) &&
               y < static_cast<std::ptrdiff_t>(front_.height);
    }
    std::size_t at(std::ptrdiff_t x, std::ptrdiff_t y) const {
        return static_cast<std::size_t>(y) * front_.width + static_cast<std::size_t>(x);
    }

    /// Returns the colour of a pixel at an edge: that of the next pixel away from the edge, if it is of the same
    /// surface. The pixel itself can have some of the nearer surface's colour.
    Rgb color_beside_edge(std::size_t pixel, std::ptrdiff_t right, std::ptrdiff_t down) const {
        const auto x = static_cast<std::ptrdiff_t>(pixel % front_.width) + right,
                   y = static_cast<std::ptrdiff_t>(pixel / front_.width) + down;
        const bool is_of_surface = is_inside(x, y) && are_joined(front_.nearness[at(x, y)], front_.nearness[pixel]);
        return color_of_(is_of_surface ? at(x, y) : pixel);
    }

    /// Returns the pixels of farther surfaces at edges.
    std::vector<std::size_t> first_ring() {
        std::vector<std::size_t> ring;
        for (std::size_t pixel = 0; pixel < front_.nearness.size(); ++pixel)
            for_neighbors(pixel, false, [&](std::size_t other, std::ptrdiff_t right, std::ptrdiff_t down) {
                if (front_.nearness[other] - front_.nearness[pixel] <= edge_step || behind_.is_present[pixel] != 0)
                    return;
                behind_.is_present[pixel] = 1;
                behind_.nearness[pixel] = front_.nearness[pixel];
                behind_.colors[pixel] = color_beside_edge(pixel, -right, -down);
                ring.push_back(pixel);
            });
        return ring;
    }

    /// Extends a pixel from the farthest of its neighbours. Returns whether it is hidden behind the front and within
    /// the width of the continuation.
    bool extend(std::size_t pixel, std::size_t number) {
        float farthest = 2;
        const auto for_known = [&](const auto& function) {
            for_neighbors(pixel, true, [&](std::size_t other, std::ptrdiff_t, std::ptrdiff_t) {
                if (behind_.is_present[other] != 0) function(other);
            });
        };
        for_known([&](std::size_t other) { farthest = std::min(farthest, behind_.nearness[other]); });
        const float step = front_.nearness[pixel] - farthest;
        const float reach = std::ceil(step * continuation_share * static_cast<float>(front_.width));
        if (step <= edge_step || static_cast<float>(number) > reach) return false;
        float count = 0, sum = 0;
        Rgb color;
        for_known([&](std::size_t other) {
            if (!are_joined(behind_.nearness[other], farthest)) return;
            sum += behind_.nearness[other];
            color += behind_.colors[other];
            ++count;
        });
        behind_.nearness[pixel] = sum / count;
        behind_.colors[pixel] = 1 / count * color;
        return true;
    }

    std::vector<std::size_t> next_ring(const std::vector<std::size_t>& ring, std::size_t number) {
        std::vector<std::size_t> next, candidates;
        for (const std::size_t pixel : ring)
            for_neighbors(pixel, false, [&](std::size_t other, std::ptrdiff_t, std::ptrdiff_t) {
                if (behind_.is_present[other] == 0) candidates.push_back(other);
            });
        std::ranges::sort(candidates);
        candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
        for (const std::size_t pixel : candidates)
            if (extend(pixel, number)) next.push_back(pixel);
        for (const std::size_t pixel : next) behind_.is_present[pixel] = 1;
        return next;
    }

    const Relief& front_;
    GridColors color_of_;
    Relief behind_;
};

}  // namespace

Mesh relief_mesh(const Relief& relief, double height) { return ReliefMesh(relief, height).build(); }

Relief continuation_behind_edges(const Relief& front, const Image& picture) {
    return Continuation(front, picture).build();
}

}  // namespace hogel::scene
