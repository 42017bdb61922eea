/* The panel by Dear ImGui: the only C++ here. It shows what it is given, and says what a hand wants as
 * actions. */
#include "window/panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <new>

namespace
{
enum { HISTORY = 120, ACTS = 8, ACT_SIZE = 256 };
}

struct panel {
    panel_desc desc;
    ImGuiContext *context;
    bool measures, help;
    float total[HISTORY], phase[PANEL_PHASES][HISTORY];
    const char *phase_name[PANEL_PHASES];
    int at;
    size_t draws;
    float iso, radius_scale;   /* while a slider is held */
    float scale;               /* of its letters, framebuffer units */
    float width;               /* of its window; 0: not shown yet */
    char acts[ACTS][ACT_SIZE]; /* what this showing asked for */
    int act_count;
};

namespace
{

void act(panel *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Done when the panel has been shown: an action may free what it is shown from. */
void act(panel *p, const char *format, ...)
{
    va_list arguments;
    if (p->act_count == ACTS) return; /* a hand does one at a time */
    va_start(arguments, format);
    vsnprintf(p->acts[p->act_count++], ACT_SIZE, format, arguments);
    va_end(arguments);
}

void choose(panel *p, const panel_choice &c)
{
    if (!ImGui::BeginCombo(c.label, c.chosen)) return;
    for (size_t i = 0; i < c.count; i++)
        if (ImGui::Selectable(c.names[i], std::strcmp(c.names[i], c.chosen) == 0))
            act(p, "%s %s", c.action, c.names[i]);
    ImGui::EndCombo();
}

/* A slider acts when it is let go: the field is read again for it. */
void slide(panel *p, const char *label, const char *name, float *held, double now, float least, float most)
{
    ImGui::SliderFloat(label, held, least, most, "%.4g", ImGuiSliderFlags_Logarithmic);
    if (ImGui::IsItemDeactivatedAfterEdit())
        act(p, "set %s %.9g", name, *held);
    else if (!ImGui::IsItemActive())
        *held = static_cast<float>(now);
}

void whole(panel *p, const char *label, const char *name, int now, int most)
{
    int value = now;
    if (ImGui::SliderInt(label, &value, 0, most) && value != now) act(p, "set %s %d", name, value);
}

void remember(panel *p, const panel_content &c)
{
    if (c.draws == p->draws) return;
    p->draws = c.draws;
    p->at = (p->at + 1) % HISTORY;
    p->total[p->at] = static_cast<float>(c.total_ms);
    for (int k = 0; k < PANEL_PHASES; k++) p->phase[k][p->at] = 0;
    for (size_t i = 0; i < c.phase_count; i++)
        for (int k = 0; k < PANEL_PHASES; k++) {
            if (p->phase_name[k] && p->phase_name[k] != c.phase[i].name) continue;
            p->phase_name[k] = c.phase[i].name;
            p->phase[k][p->at] = static_cast<float>(c.phase[i].ms);
            break;
        }
}

void graph(panel *p, const char *name, const float *history)
{
    char text[64];
    snprintf(text, sizeof text, "%s %.2f ms", name, static_cast<double>(history[p->at]));
    ImGui::PlotLines("##graph", history, HISTORY, (p->at + 1) % HISTORY, text, 0, FLT_MAX,
                     ImVec2(ImGui::GetContentRegionAvail().x, 3 * ImGui::GetFontSize()));
}

void times(panel *p)
{
    graph(p, "frame", p->total);
    ImGui::Checkbox("measure the phases", &p->measures);
    if (!p->measures) return;
    for (int k = 0; k < PANEL_PHASES; k++) {
        if (!p->phase_name[k]) continue;
        ImGui::PushID(k);
        graph(p, p->phase_name[k], p->phase[k]);
        ImGui::PopID();
    }
}

void sequence(panel *p, const panel_content &c)
{
    if (c.frames < 2) return;
    int frame = static_cast<int>(c.frame);
    if (ImGui::Button(c.plays ? "pause" : "play")) act(p, "play");
    ImGui::SameLine();
    if (ImGui::Button("<")) act(p, "step -1");
    ImGui::SameLine();
    if (ImGui::Button(">")) act(p, "step 1");
    ImGui::SameLine();
    bool loops = c.loops;
    if (ImGui::Checkbox("loop", &loops)) act(p, "loop");
    if (ImGui::SliderInt("frame", &frame, 0, static_cast<int>(c.frames) - 1)) act(p, "frame %d", frame);
    float speed = static_cast<float>(c.speed);
    if (ImGui::SliderFloat("speed", &speed, 0.0625F, 16, "%.3g", ImGuiSliderFlags_Logarithmic))
        act(p, "speed %.6g", static_cast<double>(speed) / c.speed);
}

void effects(panel *p, const panel_content &c)
{
    bool shadows = c.shadows != 0;
    if (!ImGui::CollapsingHeader("effects")) return;
    if (ImGui::Checkbox("shadows", &shadows)) act(p, shadows ? "set shadows" : "unset shadows");
    whole(p, "reflections", "reflections", c.reflections, 8);
    whole(p, "refractions", "refractions", c.refractions, 16);
    whole(p, "occlusion", "occlusion", c.occlusion, 64);
}

void controls(panel *p, const panel_content &c)
{
    for (size_t i = 0; i < c.choice_count; i++) choose(p, c.choice[i]);
    slide(p, "L", "iso", &p->iso, c.iso, 0.001F, 10);
    slide(p, "radius scale", "radius-scale", &p->radius_scale, c.radius_scale, 0.1F, 10);
    float fov = static_cast<float>(c.fov);
    if (ImGui::SliderFloat("field of view", &fov, 5, 120, "%.0f"))
        act(p, "fov %.6g", static_cast<double>(fov));
    if (c.compares) {
        ImGui::Text("difference in full at %.3g", c.scale);
        if (ImGui::Button("finer")) act(p, "scale 0.1");
        ImGui::SameLine();
        if (ImGui::Button("coarser")) act(p, "scale 10");
    }
    if (ImGui::Button("error")) act(p, "check");
    ImGui::SameLine();
    if (ImGui::Button("save")) act(p, "save");
    ImGui::SameLine();
    if (ImGui::Button("copy")) act(p, "copy");
    ImGui::SameLine();
    if (ImGui::Button("keys")) p->help = !p->help;
}

/* What the longest label takes beside its control. */
float room_for_labels(const panel_content &c)
{
    float room = ImGui::CalcTextSize("field of view").x;
    for (size_t i = 0; i < c.choice_count; i++)
        room = std::fmax(room, ImGui::CalcTextSize(c.choice[i].label).x);
    return room + ImGui::GetStyle().ItemInnerSpacing.x;
}

/* Dear ImGui counts in the window's units: where these are larger than pixels already, nothing is left to do.
 */
void fit_monitor(panel *p)
{
    GLFWwindow *window = static_cast<GLFWwindow *>(p->desc.window);
    float across = 1, down = 1;
    int units = 0, pixels = 0;
    glfwGetWindowContentScale(window, &across, &down);
    glfwGetWindowSize(window, &units, nullptr);
    glfwGetFramebufferSize(window, &pixels, nullptr);
    if (!(across > 0) || units < 1 || pixels < 1) return;
    float scale = across * static_cast<float>(units) / static_cast<float>(pixels);
    if (std::fabs(scale - p->scale) < 0.05F) return;
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImGui::GetIO().FontGlobalScale = scale;
    p->width *= scale / p->scale;
    p->scale = scale;
}

void main_window(panel *p, const panel_content &c)
{
    ImGui::SetNextWindowPos(ImVec2(8, 8), ImGuiCond_FirstUseEver);
    /* As wide as a hand has it, as high as what it shows: that comes and goes. */
    if (!(p->width > 0)) p->width = 320 * p->scale;
    ImGui::SetNextWindowSizeConstraints(ImVec2(200 * p->scale, 0),
                                        ImVec2(FLT_MAX, std::fmax(ImGui::GetIO().DisplaySize.y - 16, 64)));
    ImGui::SetNextWindowSize(ImVec2(p->width, 0));
    bool open = ImGui::Begin("meniscus");
    p->width = ImGui::GetWindowWidth();
    if (open) {
        ImGui::PushItemWidth(-room_for_labels(c));
        controls(p, c);
        sequence(p, c);
        effects(p, c);
        if (ImGui::CollapsingHeader("times", ImGuiTreeNodeFlags_DefaultOpen)) times(p);
        for (size_t i = 0; i < c.line_count; i++) ImGui::TextWrapped("%s", c.line[i]);
        if (ImGui::CollapsingHeader("left out")) ImGui::TextWrapped("%s", c.left_out);
        if (*c.status) {
            ImGui::Separator();
            ImGui::TextWrapped("%s", c.status);
        }
        ImGui::PopItemWidth();
    }
    ImGui::End();
    if (!p->help) return;
    if (ImGui::Begin("keys", &p->help, ImGuiWindowFlags_AlwaysAutoResize))
        ImGui::TextUnformatted(p->desc.help);
    ImGui::End();
}

} // namespace

bool panel_is_built_in(void)
{
    return true;
}

panel *panel_open(const panel_desc *desc)
{
    panel *p = new (std::nothrow) panel();
    if (!p) return nullptr;
    GLFWwindow *window = static_cast<GLFWwindow *>(desc->window);
    p->desc = *desc;
    p->scale = 1;
    p->context = ImGui::CreateContext();
    ImGui::SetCurrentContext(p->context);
    ImGui::GetIO().IniFilename = nullptr; /* nothing is left on disk */
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    if (ImGui_ImplOpenGL3_Init("#version 430 core")) return p;
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(p->context);
    delete p;
    return nullptr;
}

void panel_close(panel *p)
{
    if (!p) return;
    ImGui::SetCurrentContext(p->context);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(p->context);
    delete p;
}

void panel_show(panel *p, const panel_content *content)
{
    ImGui::SetCurrentContext(p->context);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    fit_monitor(p);
    ImGui::NewFrame();
    remember(p, *content);
    main_window(p, *content);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    for (int i = 0; i < p->act_count; i++) p->desc.act(p->desc.context, p->acts[i]);
    p->act_count = 0;
}

bool panel_takes_mouse(const panel *p)
{
    ImGui::SetCurrentContext(p->context);
    return ImGui::GetIO().WantCaptureMouse;
}

bool panel_takes_keys(const panel *p)
{
    ImGui::SetCurrentContext(p->context);
    return ImGui::GetIO().WantTextInput;
}

bool panel_measures(const panel *p)
{
    return p->measures;
}

void panel_help(panel *p, bool open)
{
    p->help = open;
}
