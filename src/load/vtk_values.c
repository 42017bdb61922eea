#include "load/vtk.h"

#include "base/memory.h"
#include "load/number.h"

#include <math.h>
#include <string.h>

vtk_type vtk_type_by_name(load_text name)
{
    static const struct {
        const char *name;
        vtk_type type;
    } types[] = {
        {"bit", VTK_BIT},           {"char", VTK_I8},           {"signed_char", VTK_I8},
        {"unsigned_char", VTK_U8},  {"short", VTK_I16},         {"unsigned_short", VTK_U16},
        {"int", VTK_I32},           {"vtkIdType", VTK_I32}, /* written as int whatever its size in memory */
        {"unsigned_int", VTK_U32},  {"long", VTK_I64},          {"vtktypeint64", VTK_I64},
        {"unsigned_long", VTK_U64}, {"vtktypeuint64", VTK_U64}, {"float", VTK_F32},
        {"double", VTK_F64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (text_is(name, types[i].name)) return types[i].type;
    return VTK_NONE;
}

/* Bytes of a value; 0 for bits, eight of which share one. */
static size_t size_of(vtk_type type)
{
    static const size_t size[] = {[VTK_I8] = 1,  [VTK_U8] = 1,  [VTK_I16] = 2, [VTK_U16] = 2, [VTK_I32] = 4,
                                  [VTK_U32] = 4, [VTK_I64] = 8, [VTK_U64] = 8, [VTK_F32] = 4, [VTK_F64] = 8};
    return size[type];
}

static double decode(const unsigned char *at, vtk_type type)
{
    uint64_t bits = 0;
    uint32_t single_bits;
    float single;
    double value;
    for (size_t i = 0; i < size_of(type); i++) bits = bits << 8 | at[i];
    switch (type) {
    case VTK_I8:
        return (double)(int8_t)bits;
    case VTK_I16:
        return (double)(int16_t)bits;
    case VTK_I32:
        return (double)(int32_t)bits;
    case VTK_I64:
        return (double)(int64_t)bits;
    case VTK_F32:
        single_bits = (uint32_t)bits;
        memcpy(&single, &single_bits, sizeof single);
        return single;
    case VTK_F64:
        memcpy(&value, &bits, sizeof value);
        return value;
    default:
        return (double)bits;
    }
}

/* Room for `more` values; the array doubles. */
static bool reserve(load_stream *s, vtk_values *v, size_t *capacity, size_t more)
{
    if (*capacity - v->count >= more) return true;
    size_t wanted = *capacity * 2 > v->count + more ? *capacity * 2 : v->count + more;
    double *grown = memory_resize(v->value, wanted, sizeof *grown);
    if (!grown) {
        stream_no_memory(s);
        return false;
    }
    v->value = grown;
    *capacity = wanted;
    return true;
}

enum { BLOCK = 4096 }; /* values decoded at once */

static bool read_binary(load_stream *s, vtk_type type, uint64_t count, const char *what, vtk_values *values)
{
    unsigned char bytes[BLOCK * 8];
    size_t size = size_of(type), capacity = 0;
    while (count) {
        size_t part = count < BLOCK ? (size_t)count : BLOCK;
        size_t length = size ? part * size : (part + 7) / 8;
        uint64_t byte = stream_place(s).offset;
        if (!stream_bytes(s, bytes, length)) return false;
        count -= part;
        if (!values) continue;
        if (!reserve(s, values, &capacity, part)) return false;
        for (size_t i = 0; i < part; i++, byte += size) {
            double value = size ? decode(bytes + i * size, type) : (bytes[i / 8] >> (7 - i % 8)) & 1;
            if (!isfinite(value)) {
                stream_fail(s, MNS_ERROR_INPUT, "byte %llu: %.60s has the value %g; expected a finite number",
                            (unsigned long long)byte, what, value);
                return false;
            }
            values->value[values->count++] = value;
        }
    }
    return true;
}

static bool read_ascii(load_stream *s, uint64_t count, const char *what, vtk_values *values)
{
    size_t capacity = 0;
    load_text token;
    for (uint64_t i = 0; i < count; i++) {
        double value = 0;
        if (!stream_token(s, &token)) {
            stream_fail_line(s, "the file ends after %llu of %llu values of %.60s", (unsigned long long)i,
                             (unsigned long long)count, what);
            return false;
        }
        if (!values) continue;
        if (!number_whole(token, &value)) {
            stream_fail_line(s, "%.60s has '%.*s'; expected a%s number", what, SHOWN(token),
                             number_is_special(token) ? " finite" : "");
            return false;
        }
        if (!reserve(s, values, &capacity, 1)) return false;
        values->value[values->count++] = value;
    }
    return true;
}

bool vtk_read_values(load_stream *s, bool is_binary, vtk_type type, uint64_t count, const char *what,
                     vtk_values *values)
{
    return is_binary ? read_binary(s, type, count, what, values) : read_ascii(s, count, what, values);
}
