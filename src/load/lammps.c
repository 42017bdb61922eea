/* LAMMPS text dumps: sections that begin with "ITEM:", the atoms last, frame after frame. Positions are x, xu
 * (unwrapped) or xs, xsu (in units of the box); atoms come in any order and are sorted by id. BOX BOUNDS of a
 * triclinic box are those of the upright box around it (LAMMPS manual, "Howto triclinic"). */
#include "load/lammps.h"
#include "load/cell.h"
#include "load/format.h"
#include "load/number.h"
#include "load/rows.h"

#include <string.h>

static bool lammps_is_like(load_text head)
{
    return text_begins(head, "ITEM: TIMESTEP") || text_begins(head, "ITEM: UNITS") ||
           text_begins(head, "ITEM: TIME") || text_begins(head, "ITEM: NUMBER OF ATOMS");
}

/* ---- Finding frames ---- */

/* Passes over one section that follows its heading; *is_end after the atoms. False where the file ends or is
 * not understood. */
static bool skip_section(load_stream *s, load_text heading, uint64_t *atoms, bool *is_end)
{
    load_text line;
    if (text_begins(heading, "ITEM: ATOMS")) {
        *is_end = true;
        return stream_skip_lines(s, *atoms) == *atoms;
    }
    if (text_begins(heading, "ITEM: BOX BOUNDS")) return stream_skip_lines(s, 3) == 3;
    if (!text_begins(heading, "ITEM:") || !stream_line(s, &line)) return false;
    return !text_begins(heading, "ITEM: NUMBER OF ATOMS") || number_count(line, atoms);
}

static bool lammps_scan(load_stream *s, load_frames *frames)
{
    load_place place;
    load_text line;
    while (format_next_line(s, &place, &line)) {
        uint64_t atoms = 0;
        bool is_end = false;
        if (!frames_add(frames, place)) return false;
        if (!skip_section(s, line, &atoms, &is_end)) break;
        while (!is_end)
            if (!stream_line(s, &line) || !skip_section(s, line, &atoms, &is_end)) return true;
    }
    return true;
}

/* ---- The box ---- */

static double least(double a, double b, double c, double d)
{
    double low = a < b ? a : b, other = c < d ? c : d;
    return low < other ? low : other;
}

/* From the bounds of the upright box and the tilts to corner and edges. */
static void box_from_bounds(lammps_box *box, const double low[3], const double high[3], const double tilt[3])
{
    double xy = tilt[0], xz = tilt[1], yz = tilt[2];
    double x_low = low[0] - least(0, xy, xz, xy + xz), x_high = high[0] + least(0, -xy, -xz, -xy - xz);
    double y_low = low[1] - least(0, yz, 0, 0), y_high = high[1] + least(0, -yz, 0, 0);
    const double edges[3][3] = {{x_high - x_low, 0, 0}, {xy, y_high - y_low, 0}, {xz, yz, high[2] - low[2]}};
    box->origin[0] = x_low, box->origin[1] = y_low, box->origin[2] = low[2];
    memcpy(box->edge, edges, sizeof box->edge);
}

static bool read_box(load_stream *s, load_text heading, lammps_box *box)
{
    load_text rest = {heading.at + strlen("ITEM: BOX BOUNDS"), heading.end}, word, line;
    bool has_word = table_next_field(&rest, ' ', &word);
    bool is_general = has_word && text_is(word, "abc"), is_tilted = has_word && text_is(word, "xy");
    size_t width = is_general ? 4 : is_tilted ? 3 : 2;
    double low[3], high[3], tilt[3] = {0}, value[4];
    for (int i = 0; i < 3; i++) {
        if (!stream_line(s, &line)) {
            stream_fail_line(s, "the file ends; expected 3 lines of box bounds");
            return false;
        }
        if (!cell_numbers(line, width, value)) {
            stream_fail_line(s, "'%.*s'; expected %zu numbers of box bounds", SHOWN(line), width);
            return false;
        }
        low[i] = value[0], high[i] = value[1];
        if (is_tilted) tilt[i] = value[2];
        if (is_general) {
            memcpy(box->edge[i], value, sizeof box->edge[i]);
            box->origin[i] = value[3];
        }
    }
    if (!is_general) box_from_bounds(box, low, high, tilt);
    box->is_known = true;
    return true;
}

/* ---- Headings ---- */

static bool read_count(load_stream *s, uint64_t *atoms)
{
    load_text line;
    if (!stream_line(s, &line)) {
        stream_fail_line(s, "the file ends; expected the number of atoms");
        return false;
    }
    if (number_count(line, atoms)) return true;
    stream_fail_line(s, "'%.*s'; expected the number of atoms", SHOWN(line));
    return false;
}

/* Sections up to the heading of the atoms, which it gives. */
static bool read_headings(load_stream *s, lammps_box *box, uint64_t *atoms, load_text *heading)
{
    load_place place;
    load_text line;
    bool has_count = false;
    if (!format_next_line(s, &place, heading)) {
        stream_fail_line(s, "the file ends; expected ITEM: TIMESTEP");
        return false;
    }
    while (!text_begins(*heading, "ITEM: ATOMS")) {
        bool is_fine = true;
        if (!text_begins(*heading, "ITEM:")) {
            stream_fail_line(s, "'%.*s'; expected a line that begins with ITEM:", SHOWN(*heading));
            return false;
        }
        if (text_begins(*heading, "ITEM: BOX BOUNDS"))
            is_fine = read_box(s, *heading, box);
        else if (text_begins(*heading, "ITEM: NUMBER OF ATOMS"))
            is_fine = has_count = read_count(s, atoms);
        else
            stream_line(s, &line); /* a time step, units: one line, not needed */
        if (!is_fine) return false;
        if (!stream_line(s, heading)) {
            stream_fail_line(s, "the file ends; expected ITEM: ATOMS");
            return false;
        }
    }
    if (!has_count) stream_fail_line(s, "ITEM: ATOMS comes before ITEM: NUMBER OF ATOMS");
    return has_count;
}

static bool read_atoms(load_table *t, load_stream *s, uint64_t atoms)
{
    uint64_t rest = 0;
    load_text line;
    bool has_first = atoms && stream_line(s, &line);
    if (has_first) {
        lammps_guess_roles(t, line);
        if (!table_add_row(t, s, line) || !rows_add(t, s, atoms - 1, NULL, &rest)) return false;
    }
    const unsigned long long found = has_first + rest, expected = atoms;
    if (s->status || found == expected) return !s->status;
    stream_fail_line(s, "the file ends after %llu atoms of %llu", found, expected);
    return false;
}

static mns_status lammps_read(load_stream *s, particles *p)
{
    load_table table = {.separator = ' '};
    lammps_box box = {0};
    lammps_columns columns;
    uint64_t atoms = 0;
    load_text line;
    if (!read_headings(s, &box, &atoms, &line)) return s->status;
    line.at += strlen("ITEM: ATOMS");
    if (!lammps_add_columns(&table, s, line, &columns)) goto fail;
    if (columns.is_scaled && !box.is_known) {
        stream_fail_line(s, "scaled positions without a box; expected ITEM: BOX BOUNDS before");
        goto fail;
    }
    if (!read_atoms(&table, s, atoms)) goto fail;
    if (!lammps_settle(&table, s, &columns, &box)) goto fail;
    if (box.is_known) cell_set(p, box.origin, (const double(*)[3])box.edge);
    return table_finish(&table, s, p);
fail:
    table_free(&table);
    return s->status;
}

const load_format format_lammps = {.name = "lammps",
                                   .endings = ".lammpstrj .dump .lammps .lmp ",
                                   .radius_source = "file",
                                   .is_like = lammps_is_like,
                                   .scan = lammps_scan,
                                   .read = lammps_read};
