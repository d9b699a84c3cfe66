// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/band_sources.h"

#include "hogel/camera/hogel_spectra/hogel_band_source.h"
#include "hogel/camera/narrow_band/narrow_band.h"

namespace hogel::camera {
namespace {

// Eyes whose bands are computed from the samples of a field.
class SampledBandSource final : public PupilBandSource {
  public:
    SampledBandSource(const FieldSource& field, std::span<const Viewpoint> eyes) : field_(field) {
        for (const Viewpoint& eye : eyes) bands_.emplace_back(field.grid(), eye.position, eye.pupil);
    }
    const narrow_band::BandGrid& band(std::size_t eye) const override { return bands_[eye]; }
    // Their numbers are summed before they are packed.
    double bytes_per_look(std::size_t eye) const override {
        return static_cast<double>(sizeof(std::complex<float>) * bands_[eye].plane.samples());
    }
    PackedBands draw(std::size_t first_look, std::size_t looks, const Progress& progress) const override {
        PackedBands packed;
        for (auto& eye : narrow_band::draw_narrow_bands(field_, bands_, first_look, looks, progress)) {
            packed.emplace_back();
            for (Array<std::complex<float>, 2>& band : eye) {
                packed.back().emplace_back(band);
                band = {};
            }
        }
        return packed;
    }

  private:
    const FieldSource& field_;
    std::vector<narrow_band::NarrowBand> bands_;
};

}  // namespace

std::unique_ptr<PupilBandSource> make_band_source(const FieldSource& whole, const Region& part,
                                                  const FieldSource& window, std::span<const Viewpoint> eyes,
                                                  BandSource source, const hogel_spectra::KeptWaves* kept_waves) {
    std::unique_ptr<PupilBandSource> drawing;
    if (source != BandSource::samples && whole.stereogram() != nullptr)
        drawing = hogel_spectra::make_hogel_band_source(*whole.stereogram(), part, eyes, kept_waves);
    if (!drawing && source == BandSource::hogel_spectra)
        throw Error(ErrorCode::usage, "camera",
                    "a photograph from hogels needs a stereogram that is made on demand, of hogels that are sums of as "
                    "many waves as they have samples, four times as many as the eye takes in; from samples would do");
    if (!drawing) drawing = std::make_unique<SampledBandSource>(window, eyes);
    return drawing;
}

}  // namespace hogel::camera
