// Closed form: what is typed into each sort of box, and the number that it holds afterwards.
#include "app/panels/number_boxes.h"

#include <gtest/gtest.h>
#include <imgui/imgui.h>

#include <functional>
#include <string>

namespace bruma::app {
namespace {

/// One box in a window of ImGui that nobody draws, clicked and typed into.
class NumberBoxes : public testing::Test {
  protected:
    void SetUp() override {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {400.0F, 400.0F};
        io.DeltaTime = 0.016F;
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    void TearDown() override { ImGui::DestroyContext(); }

    void frame() {
        ImGui::NewFrame();
        refused_ += take_decimal_commas();
        ImGui::SetNextWindowPos({0.0F, 0.0F});
        ImGui::SetNextWindowSize({300.0F, 200.0F});
        ImGui::Begin("window");
        box_();
        ImGui::End();
        ImGui::Render();
    }
    /// Clicks into the box, with Ctrl, which makes a box of a slider and selects its text.
    void enter(std::function<void()> box) {
        box_ = std::move(box);
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = {60.0F, 35.0F};
        io.KeyCtrl = true;
        frame();
        frame();
        io.MouseDown[0] = true;
        frame();
        io.MouseDown[0] = false;
        frame();
        io.KeyCtrl = false;
        frame();
    }
    void type(const std::string& text, bool at_once = false) {
        for (const char c : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
            if (!at_once) {
                frame();
            }
        }
        frame();
        frame();
    }
    std::string refused_;

  private:
    std::function<void()> box_;
};

TEST_F(NumberBoxes, ADecimalCommaIsAPoint) {
    for (const bool at_once : {false, true}) {
        double number = 3.25;
        const auto drag = [&] { ImGui::DragScalar("drag", ImGuiDataType_Double, &number, 1.0F); };
        enter(drag);
        type("0,5", at_once);
        EXPECT_EQ(number, 0.5);
        // A second comma is left out.
        enter([&] { ImGui::DragScalar("other drag", ImGuiDataType_Double, &number, 1.0F); });
        type("-1,2,5", at_once);
        EXPECT_EQ(number, -1.25);
        enter([&] {
            ImGui::InputDouble("box", &number);
            note_number_box(false);
        });
        type("2,5e1", at_once);
        EXPECT_EQ(number, 25.0);
        enter([&] {
            ImGui::InputDouble("other box", &number);
            note_number_box(false);
        });
        type("0.125", at_once);
        EXPECT_EQ(number, 0.125);
    }
    EXPECT_EQ(refused_, "");
}

TEST_F(NumberBoxes, AWholeNumberHasNone) {
    ImS64 number = 7;
    enter([&] {
        const ImS64 low = 0;
        const ImS64 high = 1000000;
        ImGui::SliderScalar("slider", ImGuiDataType_S64, &number, &low, &high);
        note_number_box(true);
    });
    type("2,5");
    EXPECT_EQ(number, 7);
    EXPECT_NE(refused_.find("whole number"), std::string::npos) << refused_;
    refused_.clear();
    enter([&] {
        ImGui::InputScalar("box", ImGuiDataType_S64, &number);
        note_number_box(true);
    });
    type("1.000", true);
    EXPECT_EQ(number, 7);
    EXPECT_NE(refused_, "");
    refused_.clear();
    enter([&] {
        ImGui::InputScalar("other box", ImGuiDataType_S64, &number);
        note_number_box(true);
    });
    type("12");
    EXPECT_EQ(number, 12);
    EXPECT_EQ(refused_, "");
}

TEST_F(NumberBoxes, WordsKeepTheirCommas) {
    char text[32] = "";
    enter([&] { ImGui::InputText("text", text, sizeof text); });
    type("a,b.c,d");
    EXPECT_STREQ(text, "a,b.c,d");
    EXPECT_EQ(pasted_number("a, b. c").value(), "a, b. c");
}

TEST_F(NumberBoxes, APasteIsOneNumberOrNothing) {
    double number = 3.25;
    enter([&] { ImGui::DragScalar("drag", ImGuiDataType_Double, &number, 1.0F); });
    EXPECT_EQ(pasted_number("0,5").value(), "0.5");
    EXPECT_EQ(pasted_number("1e3").value(), "1e3");
    EXPECT_FALSE(pasted_number("1,234.5"));
    EXPECT_FALSE(pasted_number("1.234,5"));
    EXPECT_FALSE(pasted_number("1,2,3"));
    ImS64 whole = 7;
    enter([&] {
        ImGui::InputScalar("box", ImGuiDataType_S64, &whole);
        note_number_box(true);
    });
    EXPECT_EQ(pasted_number("12").value(), "12");
    EXPECT_FALSE(pasted_number("1,5"));
}

}  // namespace
}  // namespace bruma::app
