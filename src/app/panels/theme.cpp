#include "app/panels/theme.h"

#include <filesystem>

namespace bruma::app {
namespace {

constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float font_pixels = 15.0F;

ImVec4 grey(float value, float opacity = 1.0F) {
    return {value, value * 1.02F, value * 1.06F, opacity};
}
ImVec4 accent(float opacity) {
    return {theme::accent.x, theme::accent.y, theme::accent.z, opacity};
}

void set_colors(ImVec4* colors) {
    colors[ImGuiCol_Text] = grey(0.86F);
    colors[ImGuiCol_TextDisabled] = theme::faint;
    colors[ImGuiCol_WindowBg] = grey(0.105F);
    colors[ImGuiCol_ChildBg] = grey(0.09F);
    colors[ImGuiCol_PopupBg] = grey(0.13F, 0.98F);
    colors[ImGuiCol_Border] = grey(0.22F);
    colors[ImGuiCol_FrameBg] = grey(0.17F);
    colors[ImGuiCol_FrameBgHovered] = grey(0.22F);
    colors[ImGuiCol_FrameBgActive] = grey(0.25F);
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = colors[ImGuiCol_TitleBgCollapsed] = grey(0.14F);
    colors[ImGuiCol_MenuBarBg] = grey(0.13F);
    colors[ImGuiCol_ScrollbarBg] = grey(0.09F);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.25F);
    colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.32F);
    colors[ImGuiCol_ScrollbarGrabActive] = grey(0.40F);
    colors[ImGuiCol_CheckMark] = theme::accent;
    colors[ImGuiCol_SliderGrab] = accent(0.75F);
    colors[ImGuiCol_SliderGrabActive] = theme::accent;
    colors[ImGuiCol_Button] = grey(0.20F);
    colors[ImGuiCol_ButtonHovered] = accent(0.45F);
    colors[ImGuiCol_ButtonActive] = accent(0.70F);
    colors[ImGuiCol_Header] = grey(0.17F);
    colors[ImGuiCol_HeaderHovered] = accent(0.30F);
    colors[ImGuiCol_HeaderActive] = accent(0.50F);
    colors[ImGuiCol_Separator] = grey(0.22F);
    colors[ImGuiCol_SeparatorHovered] = accent(0.6F);
    colors[ImGuiCol_SeparatorActive] = theme::accent;
    colors[ImGuiCol_ResizeGrip] = accent(0.15F);
    colors[ImGuiCol_ResizeGripHovered] = accent(0.5F);
    colors[ImGuiCol_ResizeGripActive] = accent(0.8F);
    colors[ImGuiCol_PlotHistogram] = accent(0.8F);
    colors[ImGuiCol_TextSelectedBg] = accent(0.35F);
    colors[ImGuiCol_NavHighlight] = accent(0.0F);
    colors[ImGuiCol_ModalWindowDimBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.45F);
    colors[ImGuiCol_TableHeaderBg] = grey(0.15F);
    colors[ImGuiCol_TableRowBgAlt] = grey(1.0F, 0.02F);
}

}  // namespace

void apply_theme(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark();
    set_colors(style.Colors);
    style.WindowPadding = {12.0F, 10.0F};
    style.FramePadding = {7.0F, 4.0F};
    style.ItemSpacing = {8.0F, 6.0F};
    style.ItemInnerSpacing = {7.0F, 4.0F};
    style.IndentSpacing = 16.0F;
    style.ScrollbarSize = 11.0F;
    style.GrabMinSize = 9.0F;
    style.WindowRounding = 6.0F;
    style.FrameRounding = 4.0F;
    style.GrabRounding = 4.0F;
    style.PopupRounding = 5.0F;
    style.ScrollbarRounding = 6.0F;
    style.WindowBorderSize = 0.0F;
    style.PopupBorderSize = 1.0F;
    style.WindowTitleAlign = {0.02F, 0.5F};
    style.ScaleAllSizes(scale);

    ImGuiIO& io = ImGui::GetIO();
    std::error_code error;
    if (std::filesystem::exists(font_file, error)) {
        io.Fonts->AddFontFromFileTTF(font_file, font_pixels * scale);
    } else {
        ImFontConfig config;
        config.SizePixels = 13.0F * scale;
        io.Fonts->AddFontDefault(&config);
    }
}

}  // namespace bruma::app
