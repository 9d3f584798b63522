#include "app/panels/volume/layout_dialog.h"

#include <fmt/core.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/panels/fields_panel.h"
#include "app/panels/number_boxes.h"
#include "app/panels/theme.h"
#include "base/error.h"
#include "io/volume/raw_layout.h"

namespace bruma::app {
namespace {

bool same_layout(const io::RawProposal& a, const io::RawProposal& b) {
    return a.size == b.size && a.type == b.type && a.endian == b.endian && a.offset == b.offset;
}

}  // namespace

void LayoutDialog::open(std::string file, std::vector<io::RawProposal> proposals) {
    close();
    file_ = std::move(file);
    std::error_code error;
    file_bytes_ = std::int64_t(std::filesystem::file_size(file_, error));
    proposals_ = std::move(proposals);
    layout_ = {};
    layout_.size = glm::ivec3(1);
    choose(proposals_.empty() ? -1 : 0);
}

void LayoutDialog::close() {
    file_.clear();
    opened_ = false;
    sliced_ = {};
    last_slice_ = std::exchange(slice_, {});
    slice_fault_.clear();
    spacing_mm_ = glm::dvec3(1.0);
}

void LayoutDialog::choose(int proposal) {
    proposal_ = proposal;
    if (proposal >= 0) {
        layout_ = proposals_[std::size_t(proposal)];
    }
}

scene::VolumeSource LayoutDialog::chosen() const {
    scene::VolumeSource source;
    source.file = file_;
    source.size = layout_.size;
    source.type = layout_.type;
    source.endian = layout_.endian;
    source.offset = layout_.offset;
    source.spacing = 1e-3 * spacing_mm_;
    return source;
}

std::int64_t LayoutDialog::bytes_needed() const {
    return layout_.offset + std::int64_t(layout_.size.x) * layout_.size.y * layout_.size.z *
                                std::int64_t(scene::bytes_per_voxel(layout_.type));
}

void LayoutDialog::show_proposals(WidgetPlaces& places) {
    const float em = ImGui::GetFontSize();
    ImGui::TextDisabled("%s", proposals_.empty() ? "Nothing likely was found: please fill in the numbers."
                                                 : "Likely layouts, the likeliest first");
    ImGui::BeginChild("proposals", {32.0F * em, 12.0F * em}, true);
    for (int n = 0; n < int(proposals_.size()); ++n) {
        const io::RawProposal& proposal = proposals_[std::size_t(n)];
        const std::string words = io::layout_words(proposal.size, proposal.type) +
                                  (proposal.endian == scene::Endian::big ? ", big endian" : "");
        ImGui::PushID(n);
        if (ImGui::Selectable(words.c_str(), n == proposal_)) {
            choose(n);
        }
        places.note_last(fmt::format("proposal-{}", n));
        ImGui::PopID();
        ImGui::TextDisabled("    %s", proposal.reason.c_str());
        tooltip(proposal.reason);
    }
    ImGui::EndChild();
}

void LayoutDialog::show_numbers() {
    ImGui::PushItemWidth(16.0F * ImGui::GetFontSize());
    ImGui::InputInt3("samples along x, y, z", &layout_.size.x);
    note_number_box(true);
    layout_.size = glm::clamp(layout_.size, glm::ivec3(1), glm::ivec3(1 << 16));
    const auto menu = [](const char* label, auto& value) {
        using Enum = std::remove_reference_t<decltype(value)>;
        const auto words = scene::enum_words<Enum>();
        if (ImGui::BeginCombo(label, std::string(words[std::size_t(value)]).c_str())) {
            for (std::size_t n = 0; n < words.size(); ++n) {
                if (ImGui::Selectable(std::string(words[n]).c_str(), n == std::size_t(value))) {
                    value = Enum(n);
                }
            }
            ImGui::EndCombo();
        }
    };
    menu("type of a sample", layout_.type);
    menu("byte order", layout_.endian);
    ImGui::InputScalar("bytes before the first", ImGuiDataType_S64, &layout_.offset);
    note_number_box(true);
    layout_.offset = std::clamp<std::int64_t>(layout_.offset, 0, file_bytes_);
    ImGui::InputScalarN("mm between samples", ImGuiDataType_Double, &spacing_mm_.x, 3, nullptr, nullptr, "%.4g");
    note_number_box(false);
    spacing_mm_ = glm::clamp(spacing_mm_, glm::dvec3(1e-9), glm::dvec3(1e9));
    ImGui::PopItemWidth();
}

void LayoutDialog::update_slice() {
    if (same_layout(sliced_, layout_)) {
        return;
    }
    sliced_ = layout_;
    slice_ = {};
    slice_fault_.clear();
    try {
        const SlicePreview preview = read_middle_slice(file_, layout_);
        std::vector<std::uint8_t> rgba;
        for (const std::uint8_t grey : preview.grey) {
            rgba.insert(rgba.end(), {grey, grey, grey, 255});
        }
        slice_ = gl::Texture::make_2d("slice of a file", GL_RGBA8, preview.size);
        slice_.upload({GL_RGBA, GL_UNSIGNED_BYTE}, rgba.data());
    } catch (const InputError& fault) {
        slice_fault_ = fault.what();
    }
}

void LayoutDialog::show_slice() {
    update_slice();
    const float edge = 20.0F * ImGui::GetFontSize();
    ImGui::BeginGroup();
    ImGui::TextDisabled("The middle slice, read this way");
    if (slice_) {
        const glm::vec2 size(slice_.size());
        const glm::vec2 shown = size * (edge / std::max(size.x, size.y));
        // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui carries a texture name in a pointer.
        ImGui::Image(reinterpret_cast<ImTextureID>(std::intptr_t(slice_.name())), {shown.x, shown.y});
    } else {
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + edge);
        ImGui::TextUnformatted(slice_fault_.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::EndGroup();
}

LayoutDialog::Answer LayoutDialog::show(WidgetPlaces& places) {
    if (!is_open()) {
        return Answer::none;
    }
    const char* id = "How do the samples lie?###layout";
    if (!std::exchange(opened_, true)) {
        ImGui::OpenPopup(id);
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5F * screen.x, 0.5F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
    Answer answer = Answer::none;
    if (!ImGui::BeginPopupModal(id, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove)) {
        opened_ = false;  // another popup took its place: it is opened again, since it still waits
        return answer;
    }
    ImGui::Text("%s has no header that says so (%lld bytes).", std::filesystem::path(file_).filename().c_str(),
                static_cast<long long>(file_bytes_));
    ImGui::Spacing();
    ImGui::BeginGroup();
    show_proposals(places);
    show_numbers();
    const std::int64_t needed = bytes_needed();
    const bool fits = needed == file_bytes_;
    if (fits) {
        ImGui::TextDisabled("This fits the file exactly.");
    } else {
        ImGui::TextColored(theme::warning, "This needs %lld bytes, %lld %s than there are.",
                           static_cast<long long>(needed), static_cast<long long>(std::abs(needed - file_bytes_)),
                           needed > file_bytes_ ? "more" : "fewer");
    }
    ImGui::EndGroup();
    ImGui::SameLine(0.0F, 1.2F * ImGui::GetFontSize());
    show_slice();
    ImGui::Separator();
    ImGui::BeginDisabled(!fits);
    if (ImGui::Button("Load", {8.0F * ImGui::GetFontSize(), 0.0F})) {
        answer = Answer::load;
    }
    places.note_last("layout-load");
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
        answer = Answer::cancel;
    }
    places.note_last("layout-cancel");
    if (answer != Answer::none) {
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    return answer;
}

}  // namespace bruma::app
