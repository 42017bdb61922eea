/* The pictures: two side by side under a divider, all in a grid, and the worst pixels, which are marked in them. */
(function (page) {
    const { element, byId } = page;
    const KINDS = [['image', 'Images'], ['depth', 'Depth differences'], ['mask', 'Hit masks']];
    const ZOOMS = [1, 2, 4, 8, 16, 32];
    const ZOOM_OF_MARK = 8, NEAR_DIVIDER = 18, STEP = 1, PAGE = 10;
    const TALLEST = 0.78; // of the window

    const list = page.pictures.list ?? [];
    const state = { split: 50, zoom: 1, center: [0.5, 0.5], mark: null };
    page.sliderState = state;

    const source = (picture) => `data:image/png;base64,${picture.png}`;
    const nameOf = (kind) => KINDS.find(([key]) => key === kind)?.[1] ?? kind;
    const optionOf = ({ run, kind }) => kind === 'image' ? run : `${run}, ${kind}`;
    const find = (run, kind) => list.findIndex((picture) => picture.run === run && picture.kind === kind);

    function frame() {
        const { view } = page.results, image = byId('image-left');
        return view ? [view.width, view.height] : [image.naturalWidth || 4, image.naturalHeight || 3];
    }

    /* Puts the layout where the state says: the divider, the zoomed pictures, the mark. */
    function place() {
        const stage = byId('stage'), [width, height] = frame();
        const most = Math.min(stage.parentElement.clientWidth, (innerHeight * TALLEST * width) / height);
        stage.style.width = `${most}px`;
        stage.style.height = `${(most * height) / width}px`;
        const box = [stage.clientWidth, stage.clientHeight];
        const half = 0.5 / state.zoom;
        state.center = state.center.map((at) => Math.min(Math.max(at, half), 1 - half));
        const shift = state.center.map((at, axis) => box[axis] * (0.5 - at * state.zoom));
        for (const image of stage.querySelectorAll('img')) {
            image.style.transform = `translate(${shift[0]}px, ${shift[1]}px) scale(${state.zoom})`;
        }
        stage.classList.toggle('zoomed', state.zoom > 1);
        byId('pane-right').style.clipPath = `inset(0 0 0 ${state.split}%)`;
        const divider = byId('divider');
        divider.style.left = `${state.split}%`;
        divider.setAttribute('aria-valuenow', Math.round(state.split));
        divider.setAttribute('aria-valuetext', `${Math.round(state.split)} % of the left picture`);
        placeMark(box, shift, width);
    }

    function placeMark(box, shift, width) {
        const mark = byId('mark');
        mark.hidden = !state.mark;
        if (!state.mark) return;
        const [, height] = frame();
        const at = [(state.mark.x + 0.5) / width, (state.mark.y + 0.5) / height];
        const side = Math.max((box[0] / width) * state.zoom + 6, 14);
        mark.style.left = `${at[0] * state.zoom * box[0] + shift[0]}px`;
        mark.style.top = `${at[1] * state.zoom * box[1] + shift[1]}px`;
        mark.style.width = mark.style.height = `${side}px`;
    }

    function setSplit(percent) {
        state.split = Math.min(Math.max(percent, 0), 100);
        place();
    }

    function setZoom(zoom) {
        state.zoom = zoom;
        byId('zoom').value = String(zoom);
        place();
    }

    /* Shows the pictures with these numbers; a negative one stays as it is. */
    page.sideBySide = function (left, right) {
        for (const [side, index] of [['left', left], ['right', right]]) {
            if (index < 0) continue;
            byId(side).value = String(index);
            byId(`image-${side}`).src = source(list[index]);
            byId(`image-${side}`).alt = `${list[index].run}: ${nameOf(list[index].kind)}`;
        }
    };

    const ratio = (event, box) => [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];

    function pointer(stage) {
        let drag = null;
        stage.addEventListener('pointerdown', (event) => {
            if (event.button !== 0) return;
            const box = stage.getBoundingClientRect(), [x] = ratio(event, box);
            const onDivider = Math.abs(x - state.split / 100) * box.width <= NEAR_DIVIDER;
            drag = { moves: onDivider || state.zoom === 1 ? 'divider' : 'picture', from: ratio(event, box), center: state.center };
            stage.setPointerCapture?.(event.pointerId);
            if (drag.moves === 'divider') setSplit(100 * x);
            byId('divider').focus({ preventScroll: true });
            event.preventDefault();
        });
        stage.addEventListener('pointermove', (event) => {
            const at = ratio(event, stage.getBoundingClientRect());
            tell(at);
            if (!event.buttons) drag = null; // let go where the stage did not hear of it
            if (drag?.moves === 'divider') setSplit(100 * at[0]);
            if (drag?.moves !== 'picture') return;
            state.center = drag.center.map((center, axis) => center - (at[axis] - drag.from[axis]) / state.zoom);
            place();
        });
        for (const end of ['pointerup', 'pointercancel']) stage.addEventListener(end, () => { drag = null; });
        stage.addEventListener('pointerleave', () => tell(null));
    }

    /* Which pixel the pointer is on; without one, which is marked. */
    function tell(at) {
        const size = frame(), { mark } = state;
        const pixel = at && at.map((part, axis) => Math.floor(size[axis] * (state.center[axis] + (part - 0.5) / state.zoom)));
        const inside = pixel && pixel.every((value, axis) => value >= 0 && value < size[axis]);
        byId('where').textContent = inside ? `pixel ${pixel[0]}, ${pixel[1]}` : mark ? `marked: pixel ${mark.x}, ${mark.y}` : '';
    }

    function keys(event) {
        const to = {
            ArrowLeft: state.split - STEP, ArrowDown: state.split - STEP, ArrowRight: state.split + STEP, ArrowUp: state.split + STEP,
            PageDown: state.split - PAGE, PageUp: state.split + PAGE, Home: 0, End: 100,
        }[event.key];
        if (to === undefined) return;
        setSplit(to);
        event.preventDefault();
    }

    function startSlider() {
        page.show('compare');
        const groups = KINDS.map(([kind, text]) => [text, list.map((picture, index) => [picture, index])
            .filter(([picture]) => picture.kind === kind).map(([picture, index]) => [String(index), optionOf(picture)])])
            .filter(([, choices]) => choices.length);
        for (const side of ['left', 'right']) {
            page.fill(byId(side), groups);
            byId(side).addEventListener('change', (event) => {
                const index = Number(event.target.value);
                page.sideBySide(side === 'left' ? index : -1, side === 'right' ? index : -1);
            });
        }
        page.fill(byId('zoom'), ZOOMS.map((zoom) => [String(zoom), `${zoom}×`]));
        byId('zoom').addEventListener('change', (event) => setZoom(Number(event.target.value)));
        byId('divider').addEventListener('keydown', keys);
        byId('image-left').addEventListener('load', place);
        pointer(byId('stage'));
        new ResizeObserver(place).observe(byId('stage').parentElement);
        const images = groups[0][1].map(([index]) => Number(index));
        const truth = Math.max(find('truth', 'image'), images[0]);
        page.sideBySide(truth, images.find((index) => index !== truth) ?? truth);
        place();
    }

    /* ---- the grid */

    function kindNote(kind) {
        const swatch = (color, text) => element('span', null, element('i', { style: `background: ${color}` }), text);
        const { mask_colors: colors, depth_range: range } = page.pictures;
        if (kind === 'depth') {
            return [`Blue: nearer than the truth; red: farther; grey: nothing to compare. Full colour at ${page.number(range)} pixel footprint`
                + `${range === 1 ? '' : 's'} (where the view is unknown, at ${page.number(range)}‰ of the distance); the scale is asinh, so that small differences show.`];
        }
        if (kind !== 'mask' || !colors) return ['As drawn. A picture goes to the right of the divider by a click.'];
        return [element('span', { class: 'legend' }, ['neither hits', 'both hit', 'missed', 'invented', 'undecided']
            .map((text, index) => colors[index] ? swatch(colors[index], text) : null))];
    }

    function drawGrid(kind) {
        const [width, height] = frame();
        for (const button of byId('kinds').children) button.setAttribute('aria-pressed', button.dataset.kind === kind);
        byId('kind-note').replaceChildren(...kindNote(kind));
        byId('grid').replaceChildren(...list.map((picture, index) => [picture, index]).filter(([picture]) => picture.kind === kind)
            .map(([picture, index]) => element('figure', null,
                element('button', {
                    type: 'button', title: 'Show on the right of the divider',
                    onclick() {
                        page.sideBySide(-1, index);
                        byId('compare').scrollIntoView({ block: 'start' });
                    },
                }, element('img', { src: source(picture), alt: `${picture.run}: ${nameOf(kind)}`, width, height, decoding: 'async' })),
                element('figcaption', null, picture.run))));
    }

    function startGrid() {
        page.show('pictures');
        const kinds = KINDS.filter(([kind]) => list.some((picture) => picture.kind === kind));
        byId('kinds').append(...kinds.map(([kind, text]) =>
            element('button', { type: 'button', 'data-kind': kind, onclick: () => drawGrid(kind) }, text)));
        drawGrid(kinds[0][0]);
    }

    /* ---- the worst pixels */

    function mark(pixel, row) {
        for (const other of row.parentElement.children) other.setAttribute('aria-selected', other === row);
        state.mark = { x: pixel.x, y: pixel.y };
        const [width, height] = frame();
        state.center = [(pixel.x + 0.5) / width, (pixel.y + 0.5) / height];
        const image = find(pixel.run, 'image');
        page.sideBySide(find('truth', 'image'), image < 0 ? find(pixel.run, 'mask') : image);
        setZoom(state.zoom > 1 ? state.zoom : ZOOM_OF_MARK);
        tell(null);
        byId('compare').scrollIntoView({ block: 'start' });
    }

    function drawWorst(pixels) {
        const row = (pixel) => {
            const choose = () => { if (list.length) mark(pixel, made); };
            const made = element('tr', {
                class: list.length ? 'choice' : null, tabindex: list.length ? 0 : null, onclick: choose,
                onkeydown(event) { if (event.key === 'Enter') choose(); },
            }, element('td', { class: 'word' }, pixel.run), element('td', null, `${pixel.x}, ${pixel.y}`),
            element('td', { class: 'word' }, String(pixel.kind)),
            [pixel.t, pixel.truth].map((t) => element('td', null, page.isNumber(t) ? String(Number(t.toPrecision(9))) : 'no hit')),
            element('td', null, page.number(pixel.error)));
            return made;
        };
        const heads = [['Run', 'word'], ['Pixel x, y'], ['What', 'word'], ['t'], ['true t'], ['|t − t*| / max(t*, R)']];
        byId('worst-table').replaceChildren(
            element('thead', null, element('tr', null, heads.map(([text, name]) => element('th', { scope: 'col', class: name }, text)))),
            element('tbody', null, pixels.map(row)));
    }

    /* The first of every run, then the second of every run: none crowds the others out. */
    function startWorst() {
        const runs = page.runs.filter((run) => run.worst?.length);
        if (!runs.length) return;
        page.show('worst');
        byId('worst-hint').hidden = !list.length;
        const of = (run) => run.worst.map((pixel) => ({ ...pixel, run: run.name }));
        const select = byId('worst-run');
        page.fill(select, [['', 'all, a rank at a time'], ...runs.map((run, index) => [String(index), run.name])]);
        const longest = Math.max(...runs.map((run) => run.worst.length));
        const ranked = Array.from({ length: longest }, (_, rank) => runs.map((run) => of(run)[rank]).filter(Boolean)).flat();
        const draw = () => drawWorst(select.value === '' ? ranked : of(runs[Number(select.value)]));
        select.addEventListener('change', draw);
        draw();
    }

    page.startPictures = function () {
        if (list.length) {
            startSlider();
            startGrid();
        }
        startWorst();
    };
})(meniscus);
