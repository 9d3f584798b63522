#pragma once
#include <string>
#include <vector>

#include "app/panels/widget_places.h"
#include "gl/texture.h"
#include "io/volume/raw_proposals.h"

namespace bruma::app {

/// Asks how the samples of a headerless file lie: a list of proposals with their reasons, numbers to change, and a
/// picture of the middle slice as it would be.
class LayoutDialog {
  public:
    void open(std::string file, std::vector<io::RawProposal> proposals);
    bool is_open() const { return !file_.empty(); }

    /// What a person decided in this frame.
    enum class Answer { none, load, cancel };
    Answer show(WidgetPlaces& places);
    const std::string& file() const { return file_; }
    /// The chosen layout as hints for loading.
    scene::VolumeSource chosen() const;
    void close();

  private:
    void choose(int proposal);
    void show_proposals(WidgetPlaces& places);
    void show_numbers();
    void show_slice();
    void update_slice();
    std::int64_t bytes_needed() const;

    std::string file_;
    std::int64_t file_bytes_ = 0;
    std::vector<io::RawProposal> proposals_;
    int proposal_ = -1;
    io::RawProposal layout_;
    glm::dvec3 spacing_mm_{1.0};
    bool opened_ = false;
    io::RawProposal sliced_;  ///< the layout that the slice shows
    std::string slice_fault_;
    gl::Texture slice_;
    gl::Texture last_slice_;  ///< of a dialog that was closed: its last frame is drawn after the answer
};

/// The middle slice along z of a headerless file, as grey values from the slice's smallest to its largest value, one
/// byte a sample, top row first. Throws InputError when the file is too short.
struct SlicePreview {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> grey;
};
SlicePreview read_middle_slice(const std::string& file, const io::RawProposal& layout);

}  // namespace bruma::app
