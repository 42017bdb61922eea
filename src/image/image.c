/* Images in memory, and the choice of a format by the name's ending. */
#include "image/image.h"

#include "base/memory.h"
#include "image/output.h"

#include <string.h>
#include <strings.h>

mns_status image_create(int width, int height, mns_image **image, mns_error *error)
{
    if (width < 1 || height < 1 || width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX)
        return status_fail(error, MNS_ERROR_USAGE, "an image of %d x %d pixels: each side must be 1 to %d",
                           width, height, IMAGE_SIDE_MAX);
    size_t pixels = (size_t)width * (size_t)height;
    mns_image *made = calloc(1, sizeof *made);
    if (!made) return status_no_memory(error, "making an image");
    made->width = width, made->height = height;
    made->t_unit = 1;
    made->rgba = memory_array(pixels, 4 * sizeof(float));
    made->t = memory_array(pixels, sizeof(float));
    made->t_lo = memory_array(pixels, sizeof(float));
    made->normal = memory_array(pixels, 3 * sizeof(float));
    made->certain = memory_array(pixels, sizeof(float));
    if (!made->rgba || !made->t || !made->t_lo || !made->normal || !made->certain) {
        mns_image_destroy(made);
        return status_no_memory(error, "making an image");
    }
    *image = made;
    return MNS_OK;
}

void mns_image_destroy(mns_image *image)
{
    if (!image) return;
    free(image->rgba);
    free(image->t);
    free(image->t_lo);
    free(image->normal);
    free(image->certain);
    free(image->t_error);
    free(image->work);
    free(image->shadow);
    free(image->occlusion);
    free(image->mirror_t);
    free(image->refract_t);
    free(image->effects_certain);
    free(image->mesh);
    free(image);
}

static bool ends_with(const char *path, const char *ending)
{
    size_t length = strlen(path), tail = strlen(ending);
    return length > tail && !strcasecmp(path + length - tail, ending);
}

/* What a host may have got wrong in an image of its own making; a PNG needs the colours alone. */
static mns_status check(const mns_image *image, bool colors_only, const char *path, mns_error *error)
{
    if (image->width < 1 || image->height < 1 || image->width > IMAGE_SIDE_MAX ||
        image->height > IMAGE_SIDE_MAX)
        return status_fail(error, MNS_ERROR_USAGE,
                           "%s: an image of %d x %d pixels: each side must be 1 to %d", path, image->width,
                           image->height, IMAGE_SIDE_MAX);
    const char *absent = !image->rgba      ? "rgba"
                         : colors_only     ? NULL
                         : !image->t       ? "t"
                         : !image->t_lo    ? "t_lo"
                         : !image->normal  ? "normal"
                         : !image->certain ? "certain"
                                           : NULL;
    if (absent) return status_fail(error, MNS_ERROR_USAGE, "%s: the image has no plane %s", path, absent);
    return MNS_OK;
}

mns_status mns_image_write(const mns_image *image, const char *path, mns_error *error)
{
    if (!image || !path) return status_fail(error, MNS_ERROR_USAGE, "image: no image to write, or no name");
    bool is_png = ends_with(path, ".png");
    if (!is_png && !ends_with(path, ".exr"))
        return status_fail(error, MNS_ERROR_USAGE, "%s: unknown ending; expected .png or .exr", path);
    mns_status status = check(image, is_png, path, error);
    if (status != MNS_OK) return status;
    if (!is_png && image->t_unit > 0 && image->t_unit != 1)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "%s: distances in units of %g: an EXR's floats do not hold them in scene units; "
                           "write a .png, or scale the input",
                           path, image->t_unit);

    output_file output;
    status = output_open(&output, path, error);
    if (status != MNS_OK) return status;
    status = (is_png ? image_write_png : image_write_exr)(image, output.file, path, error);
    if (status == MNS_OK) return output_commit(&output, error);
    output_discard(&output);
    return status;
}
