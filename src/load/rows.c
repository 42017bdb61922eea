#include "load/rows.h"

#include "base/memory.h"

#include <string.h>

/* Pieces are many more than cores, so that a core that is busy elsewhere holds up little. A short file is
 * one. */
enum { PIECE_BYTES = 1 << 16, PIECES_MOST = 128 };

/* Some lines of the block, and where their rows go. */
typedef struct piece {
    load_text text;
    uint64_t lines;
    size_t first, room; /* rows of the whole table: from here on, at most */
    load_table table; /* its columns' values are the whole table's, from `first` on; its labels are its own */
    load_stream stream; /* nothing but a place to fail in */
    mns_error error;
} piece;

typedef struct rows {
    load_table *table;
    load_stream *stream;
    rows_pass_over *pass_over;
    piece *piece;
    size_t count;
} rows;

/* ---- Cutting ---- */

static void cut_pieces(rows *r, load_text block)
{
    size_t size = (size_t)(block.end - block.at), most = size / PIECE_BYTES + 1;
    r->count = most < PIECES_MOST ? most : PIECES_MOST;
    const char *at = block.at;
    for (size_t i = 0; i < r->count; i++) {
        const char *end = block.at + size / r->count * (i + 1), *newline = NULL;
        if (end < at) end = at; /* a long line took this piece, too */
        if (i + 1 < r->count && end < block.end) newline = memchr(end, '\n', (size_t)(block.end - end));
        end = newline ? newline + 1 : block.end;
        r->piece[i].text = (load_text){at, end};
        at = end;
    }
}

static void count_lines(rows *r)
{
#pragma omp parallel for schedule(dynamic, 1) if (r->count > 1)
    for (size_t i = 0; i < r->count; i++) {
        load_text text = r->piece[i].text;
        r->piece[i].lines = text_count_lines(text) + (text.at < text.end && text.end[-1] != '\n');
    }
}

/* Leaves `most` lines in the pieces; gives how many there are then. */
static uint64_t limit_lines(rows *r, uint64_t most)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < r->count; i++) {
        piece *p = &r->piece[i];
        if (p->lines > most - sum) {
            p->text.end = text_skip_lines(p->text, most - sum);
            p->lines = most - sum;
        }
        sum += p->lines;
    }
    return sum;
}

/* ---- Reading ---- */

/* Gives each piece its part of the table. A row has a byte a column at least, whatever the lines. */
static bool share_table(rows *r)
{
    load_table *t = r->table;
    size_t rows_sum = 0;
    for (size_t i = 0; i < r->count; i++) {
        piece *p = &r->piece[i];
        uint64_t good = ((uint64_t)(p->text.end - p->text.at) + 1) / t->column_count + 1;
        p->room = (size_t)(p->lines < good ? p->lines : good);
        p->first = t->row_count + rows_sum;
        rows_sum += p->room;
    }
    if (!table_reserve(t, r->stream, rows_sum)) return false;
    uint64_t line = r->stream->line;
    for (size_t i = 0; i < r->count; i++) {
        piece *p = &r->piece[i];
        for (size_t c = 0; c < t->column_count; c++)
            p->table.column[c] = (load_column){
                .name = t->column[c].name, .role = t->column[c].role, .value = t->column[c].value + p->first};
        p->table.column_count = t->column_count;
        p->table.row_count = 0;
        p->table.capacity = p->room;
        p->table.separator = t->separator;
        p->stream = (load_stream){.error = &p->error, .file = -1, .line = line};
        memcpy(p->stream.name, r->stream->name, sizeof p->stream.name);
        line += p->lines;
    }
    return true;
}

static void read_piece(piece *p, rows_pass_over *pass_over)
{
    load_text rest = p->text, line;
    while (text_next_line(&rest, &line)) {
        p->stream.line++;
        if (pass_over && pass_over(line)) continue;
        if (!table_add_row(&p->table, &p->stream, line)) return;
    }
}

/* ---- Putting together ---- */

/* Numbers of a piece's labels become those of the whole table, in the order in which their words came. */
static bool join_labels(load_column *whole, const load_column *part, load_stream *s, size_t count)
{
    size_t *number = memory_array(part->labels.count, sizeof *number);
    bool is_fine = number;
    for (size_t i = 0; is_fine && i < part->labels.count; i++)
        is_fine = labels_number(&whole->labels, text_of(part->labels.word[i]), &number[i]);
    for (size_t i = 0; is_fine && i < count; i++) part->value[i] = (double)number[(size_t)part->value[i]];
    free(number);
    if (!is_fine) stream_no_memory(s);
    return is_fine;
}

/* Adds a piece's rows to the table, or takes its failure over. */
static bool join_piece(rows *r, const piece *p)
{
    load_table *t = r->table;
    load_stream *s = r->stream;
    s->line += p->lines;
    if (p->stream.status) {
        s->line = p->stream.line;
        s->status = p->stream.status;
        if (s->error) *s->error = p->error;
        return false;
    }
    for (size_t c = 0; c < t->column_count; c++) {
        const load_column *part = &p->table.column[c];
        if (part->role == ROLE_LABEL && !join_labels(&t->column[c], part, s, p->table.row_count))
            return false;
        double *to = t->column[c].value + t->row_count;
        if (to != part->value) memmove(to, part->value, p->table.row_count * sizeof *to);
    }
    t->row_count += p->table.row_count;
    return true;
}

static bool read_pieces(rows *r)
{
    if (!share_table(r)) return false;
#pragma omp parallel for schedule(dynamic, 1) if (r->count > 1)
    for (size_t i = 0; i < r->count; i++) read_piece(&r->piece[i], r->pass_over);
    bool is_fine = true;
    for (size_t i = 0; is_fine && i < r->count; i++) is_fine = join_piece(r, &r->piece[i]);
    for (size_t i = 0; i < r->count; i++)
        for (size_t c = 0; c < r->table->column_count; c++) labels_free(&r->piece[i].table.column[c].labels);
    return is_fine;
}

static bool make_pieces(rows *r)
{
    r->piece = calloc(PIECES_MOST, sizeof *r->piece);
    bool is_fine = r->piece;
    for (size_t i = 0; is_fine && i < PIECES_MOST; i++) {
        load_table *part = &r->piece[i].table;
        part->column = memory_array(r->table->column_count, sizeof *part->column);
        is_fine = part->column;
    }
    if (!is_fine) stream_no_memory(r->stream);
    return is_fine;
}

bool rows_add(load_table *t, load_stream *s, uint64_t most, rows_pass_over *pass_over, uint64_t *taken)
{
    rows r = {.table = t, .stream = s, .pass_over = pass_over};
    bool is_fine = make_pieces(&r);
    load_text block;
    *taken = 0;
    while (is_fine && *taken < most && stream_peek_lines(s, &block)) {
        cut_pieces(&r, block);
        count_lines(&r);
        uint64_t lines = limit_lines(&r, most - *taken);
        const char *end = block.at;
        for (size_t i = 0; i < r.count; i++)
            if (r.piece[i].lines) end = r.piece[i].text.end;
        is_fine = read_pieces(&r);
        stream_pass(s, end);
        *taken += lines;
    }
    for (size_t i = 0; r.piece && i < PIECES_MOST; i++) free(r.piece[i].table.column);
    free(r.piece);
    return is_fine && !s->status;
}
