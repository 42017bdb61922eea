#include "window/action.h"

#include "base/status.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct action_row {
    const char *name, *arguments;
    int numbers; /* -1: a text is expected; -2: it may be left out */
    act *run;
    const char *doc;
} action_row;

static const action_row ROWS[] = {
    {"orbit", "A B", 2, action_orbit, "the camera goes around, A degrees to the left and B upwards"},
    {"turn", "A B", 2, action_turn, "the look turns, A degrees to the right and B upwards"},
    {"pan", "X Y", 2, action_pan, "the camera moves, by parts of the picture's height"},
    {"zoom", "F", 1, action_zoom, "the distance becomes F times what it is"},
    {"fly", "X Y Z", 3, action_fly, "the camera moves right, up and ahead, scene units"},
    {"fit", "", 0, action_fit, "the whole field fits the window"},
    {"home", "", 0, action_home, "back to the first view"},
    {"spin", "S", 1, action_spin, "goes around for S seconds, and tells how fast the pictures came"},
    {"side", "NAME", -1, action_side_of, "looks from the front, back, left, right, top or bottom"},
    {"fov", "DEG", 1, action_fov, "the field of view"},
    {"widen", "F", 1, action_widen, "the field of view becomes F times what it is"},
    {"centre", "X Y", 2, action_centre, "centres on the surface under a pixel"},
    {"set", "NAME VALUE", -1, action_set, "an option of this command, --NAME VALUE"},
    {"unset", "NAME", -1, action_unset, "as if --NAME were not given"},
    {"next", "NAME", -1, action_next,
     "the next method, solver, kernel, look, color-by, color-map, aa, compare or other"},
    {"open", "FILE", -1, action_open_input, "opens another input or scene, as a dropped file"},
    {"compare", "HOW", -1, action_compare, "off, divider, flicker or difference"},
    {"other", "METHOD:SOLVER", -1, action_other, "what to compare with"},
    {"divider", "X", 1, action_divider, "its place, 0 to 1"},
    {"scale", "F", 1, action_scale, "the difference shown in full becomes F times what it is"},
    {"check", "", 0, action_check_it, "the error against the reference, in the background"},
    {"hover", "", 0, action_hover_on, "says what is under the cursor, or no longer"},
    {"play", "", 0, action_play, "plays the sequence, or pauses"},
    {"pause", "", 0, action_pause_it, "pauses"},
    {"step", "N", 1, action_step, "N frames on"},
    {"frame", "N", 1, action_frame, "goes to a frame"},
    {"speed", "F", 1, action_speed, "plays F times as fast"},
    {"loop", "", 0, action_loop, "begins again at the end, or no longer"},
    {"size", "W H", 2, action_size, "the window's size"},
    {"whole", "", 0, action_whole, "draws the whole picture, however long it takes"},
    {"save", "FILE", -2, action_save, "the picture, .png or .exr, or the scene, .json"},
    {"grab", "FILE", -1, action_grab, "the window as it is, .png"},
    {"copy", "", 0, action_copy, "copies the command line that renders this view"},
    {"reload", "", 0, action_reload, "reads the shaders of --glsl again"},
    {"panel", "", 0, action_panel_toggle, "shows the panel, or hides it"},
    {"help", "", 0, action_help, "shows the keys"},
    {"key", "NAME", -1, action_key, "what the key of that name does"},
    {"drag", "BUTTON X0 Y0 X1 Y1", 5, action_drag, "the mouse, from pixel to pixel; button 0, 1 or 2"},
    {"move", "X Y", 2, action_move, "the cursor"},
    {"scroll", "N", 1, action_scroll, "the wheel"},
    {"tell", "WORD", -1, action_tell, "counts of what was drawn"},
    {"rest", "", 0, action_rest, "waits until the picture is whole"},
    {"sleep", "MS", 1, action_sleep_ms, "waits"},
    {"quit", "", 0, action_quit, "closes the window"},
};

enum { ROW_COUNT = sizeof ROWS / sizeof *ROWS };

static mns_status read_words(const action_row *row, const char *text, words *w, mns_error *error)
{
    *w = (words){.text = text};
    bool good = row->numbers == -2 || (row->numbers == -1 && *text) || (row->numbers == 0 && !*text);
    for (int i = 0; i < row->numbers; i++) {
        char *end;
        w->number[i] = strtod(text, &end);
        good = end != text && isfinite(w->number[i]) && (i + 1 < row->numbers ? *end == ' ' : !*end);
        if (!good) break;
        text = end;
    }
    if (good) return MNS_OK;
    return status_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected %s %s", row->name, w->text, row->name,
                       row->arguments);
}

mns_status action_run(viewer *v, const char *line, mns_error *error)
{
    size_t length = strcspn(line, " ");
    const char *rest_of = line + length + strspn(line + length, " ");
    for (int i = 0; i < ROW_COUNT; i++) {
        const action_row *row = &ROWS[i];
        if (strlen(row->name) != length || strncmp(row->name, line, length) != 0) continue;
        words w;
        mns_status status = read_words(row, rest_of, &w, error);
        return status ? status : row->run(v, &w, error);
    }
    return status_fail(error, MNS_ERROR_USAGE, "%.80s: no action has this name", line);
}

void action_do(viewer *v, const char *line)
{
    mns_error error;
    if (action_run(v, line, &error)) viewer_tell_error(v, &error);
    v->polish = 2;
}

char *window_actions_text(void)
{
    size_t size = 0, used = 0;
    for (int i = 0; i < ROW_COUNT; i++) size += strlen(ROWS[i].doc) + 40;
    char *text = malloc(size + 1);
    for (int i = 0; text && i < ROW_COUNT; i++) {
        char head[40];
        snprintf(head, sizeof head, "%s%s%s", ROWS[i].name, *ROWS[i].arguments ? " " : "", ROWS[i].arguments);
        used += (size_t)snprintf(text + used, size + 1 - used, "  %-24s %s\n", head, ROWS[i].doc);
    }
    return text;
}
