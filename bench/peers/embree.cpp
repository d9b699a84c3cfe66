// SPDX-License-Identifier: Apache-2.0
// The only file of hogel-bench that includes Embree.
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>

#include "bench/peers/renderers.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::bench {
namespace {

// Works in single precision. Positions are (x, y, ζ) in widths of the hologram; a ray's direction is (U, V, 1).
template <std::size_t side>
class EmbreePeer final : public RenderPeer {
  public:
    EmbreePeer(const ShadedScene& scene, const LightFieldGrid& grid)
        : grid_(grid), background_(scene.background), scale_(1 / (grid.pitch * static_cast<double>(grid.hogels_s))) {
        device_ = rtcNewDevice(nullptr);
        if (!device_) throw Error(ErrorCode::internal, "no Embree device");
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.positions.size()));
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), scene.triangles.size()));
        if (!vertices || !indices) throw Error(ErrorCode::internal, "Embree has no room for the scene");
        for (const Vec3& p : scene.positions)
            for (const double x : {p.x, p.y, -p.z}) *vertices++ = static_cast<float>(scale_ * x);
        colours_.reserve(scene.triangles.size());
        for (const ShadedScene::Triangle& triangle : scene.triangles) {
            indices = std::copy(triangle.vertices.begin(), triangle.vertices.end(), indices);
            const auto& [a, b, c] = triangle.vertices;
            const Rgb first = scene.radiance[a];
            colours_.push_back({first, scene.radiance[b] + -1.0f * first, scene.radiance[c] + -1.0f * first});
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
            throw Error(ErrorCode::internal, "Embree does not take the scene");
    }
    ~EmbreePeer() override {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    std::size_t min_hogels() const override { return thread_count(); }

    void render(std::span<const HogelIndex> hogels) override {
        values_.resize(hogels.size() * 3 * grid_.directions());
        const std::size_t rows = (grid_.directions_v + side - 1) / side;
        const std::size_t bands = (rows + rows_of_squares - 1) / rows_of_squares;
        work::parallel_for(hogels.size() * bands, [&](std::size_t task) {
            const std::size_t hogel = task / bands, first = task % bands * rows_of_squares;
            float* values = values_.data() + hogel * 3 * grid_.directions();
            for (std::size_t row = first; row < std::min(rows, first + rows_of_squares); ++row)
                for (std::size_t u0 = 0; u0 < grid_.directions_u; u0 += side)
                    trace(hogels[hogel], row * side, u0, values);
        });
    }

    Rgb sample(std::size_t i, std::size_t v, std::size_t u) const override {
        const float* pixel = values_.data() + i * 3 * grid_.directions() + v * grid_.directions_u + u;
        return {pixel[0], pixel[grid_.directions()], pixel[2 * grid_.directions()]};
    }

  private:
    static constexpr std::size_t rays = side * side;
    static constexpr std::size_t rows_of_squares = 64 / side;  // traced as one task

    void trace(HogelIndex hogel, std::size_t v0, std::size_t u0, float* values) const {
        const std::size_t nv = std::min(side, grid_.directions_v - v0), nu = std::min(side, grid_.directions_u - u0);
        alignas(64) RTCRayHitNt<rays> batch;
        const auto s = static_cast<float>(scale_ * grid_.s(static_cast<double>(hogel.s)));
        const auto t = static_cast<float>(scale_ * grid_.t(static_cast<double>(hogel.t)));
        const auto U = static_cast<float>(grid_.u(static_cast<double>(u0))),
                   V = static_cast<float>(grid_.v(static_cast<double>(v0)));
        const auto step_u = static_cast<float>(grid_.step_u()), step_v = static_cast<float>(grid_.step_v());
        for (std::size_t i = 0; i < rays; ++i) {
            const std::size_t u = i % side, v = i / side;
            batch.ray.org_x[i] = s, batch.ray.org_y[i] = t, batch.ray.org_z[i] = 0;
            batch.ray.dir_x[i] = U + static_cast<float>(u) * step_u;
            batch.ray.dir_y[i] = V - static_cast<float>(v) * step_v;
            batch.ray.dir_z[i] = 1;
            batch.ray.tnear[i] = 0;
            // Rays beyond the border are disabled: they end before they begin.
            batch.ray.tfar[i] = u < nu && v < nv ? std::numeric_limits<float>::infinity() : -1;
            batch.ray.time[i] = 0, batch.ray.mask[i] = ~0u, batch.ray.id[i] = 0, batch.ray.flags[i] = 0;
            batch.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        if constexpr (rays == 16) {
            alignas(64) static constexpr std::array<int, 16> all{-1, -1, -1, -1, -1, -1, -1, -1,
                                                                 -1, -1, -1, -1, -1, -1, -1, -1};
            rtcIntersect16(all.data(), scene_, &context, reinterpret_cast<RTCRayHit16*>(&batch));
        } else {
            rtcIntersectNM(scene_, &context, reinterpret_cast<RTCRayHitN*>(&batch), rays, 1, sizeof(batch));
        }
        const std::size_t plane = grid_.directions();
        for (std::size_t v = 0; v < nv; ++v)
            for (std::size_t u = 0; u < nu; ++u) {
                const std::size_t i = v * side + u;
                Rgb radiance = background_;
                if (batch.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
                    const auto& [base, along_u, along_v] = colours_[batch.hit.primID[i]];
                    radiance = base + batch.hit.u[i] * along_u + batch.hit.v[i] * along_v;
                }
                float* pixel = values + (v0 + v) * grid_.directions_u + u0 + u;
                pixel[0] = radiance.r, pixel[plane] = radiance.g, pixel[2 * plane] = radiance.b;
            }
    }

    // A triangle's radiance as a linear function of the barycentric weights that Embree returns.
    struct Colour {
        Rgb base, along_u, along_v;
    };

    LightFieldGrid grid_;
    Rgb background_;
    double scale_;
    std::vector<Colour> colours_;
    std::vector<float> values_;  // [hogel][c][v][u]
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<RenderPeer> make_embree_peer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t side) {
    if (side == 4) return std::make_unique<EmbreePeer<4>>(scene, grid);
    return std::make_unique<EmbreePeer<16>>(scene, grid);
}

}  // namespace hogel::bench
