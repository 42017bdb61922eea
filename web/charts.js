/* The charts: every run's error against its time, and the phases of the times. */
(function (page) {
    const SHAPES = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot', 'rectRounded', 'cross'];
    const COLORS = 8;
    /* Where all values are zero there is no smallest one to put the floor under. */
    const FLOOR_OF_COUNTS = 0.1, FLOOR_ALONE = 1e-10;

    const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    /* Every turn of the colours begins with another shape, so that no two curves share both. */
    const curveShape = (index) => SHAPES[(index + 3 * Math.floor(index / COLORS)) % SHAPES.length];
    const curveColor = (index) => color(`curve-${index % COLORS}`);

    /* Below every value that a logarithm can show, a power of ten: where zeros are drawn. */
    function floorUnder(values, isCount) {
        const positive = values.filter((value) => value > 0);
        if (isCount) return FLOOR_OF_COUNTS;
        if (!positive.length) return FLOOR_ALONE;
        const smallest = Math.min(...positive);
        return Math.max(10 ** (Math.floor(Math.log10(smallest) + 1e-9) - 1), Number.MIN_VALUE);
    }

    /* {points, left, floor, hasZero}: what can be drawn of `figure`, and the names of the runs that have no value. */
    page.pointsOf = function (figure) {
        const points = [], left = [];
        for (const run of page.runs) {
            const value = run.errors && figure.of(run.errors);
            if (!page.isNumber(value) || !(run.ms?.median > 0)) left.push(run.name);
            else points.push({ x: run.ms.median, error: value, run });
        }
        const floor = floorUnder(points.map((point) => point.error), figure.isCount);
        for (const point of points) point.y = point.error > 0 ? point.error : floor;
        return { points, left, floor, hasZero: points.some((point) => point.error === 0) };
    };

    /* The points that no other one beats in both, fastest first. */
    page.frontOf = function (points) {
        const sorted = [...points].sort((a, b) => a.x - b.x || a.error - b.error);
        const front = [];
        for (const point of sorted) {
            if (!front.length || point.error < front.at(-1).error) front.push(point);
        }
        return front;
    };

    function curves(points) {
        const names = [...new Set(page.measured.map(page.curve))]; // so that colours stay when the figure changes
        return names.map((name, index) => ({
            label: name,
            data: points.filter((point) => page.curve(point.run) === name).sort((a, b) => a.x - b.x),
            borderColor: curveColor(index),
            backgroundColor: curveColor(index),
            pointBackgroundColor: (context) => context.raw?.error === 0 ? color('back') : curveColor(index),
            pointStyle: curveShape(index),
            pointRadius: 6,
            pointHoverRadius: 8,
            pointBorderWidth: 2,
            borderWidth: 1.5,
        })).filter((curve) => curve.data.length);
    }

    function frontSet(front) {
        return {
            label: 'Pareto front',
            data: front.map((point) => ({ x: point.x, y: point.y })),
            isFront: true,
            stepped: 'before',
            borderColor: color('soft'),
            backgroundColor: 'transparent',
            borderDash: [2, 4],
            borderWidth: 1.5,
            pointRadius: 0,
            pointHitRadius: 0,
            pointHoverRadius: 0,
            pointStyle: 'line',
            order: 9,
        };
    }

    const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';
    function powerOfTen(exponent) {
        if (exponent >= 0 && exponent <= 3) return String(10 ** exponent);
        if (exponent < 0 && exponent >= -2) return (10 ** exponent).toFixed(-exponent);
        const digits = String(Math.abs(exponent)).replace(/\d/g, (digit) => SUPERSCRIPTS[digit]);
        return `10${exponent < 0 ? '⁻' : ''}${digits}`;
    }

    /* Powers of ten; 2 and 5 times them too where the axis is short, and all digits where it is shorter than a decade. An
     * axis has its ends among its ticks, which are no such numbers. */
    function tickText(value, decades) {
        const exponent = Math.floor(Math.log10(value) + 1e-9), digit = value / 10 ** exponent;
        const is = (wanted) => Math.abs(digit - wanted) < 1e-6;
        if (is(1)) return powerOfTen(exponent);
        const shown = decades < 1 ? [1.5, 2, 3, 4, 5, 6, 7, 8, 9] : decades < 2 ? [2, 5] : [];
        return shown.some(is) ? page.number(value) : '';
    }

    function logAxis(title, range, more, zero) {
        const decades = Math.log10(range[1] / range[0]);
        const text = (value) => value === zero ? '0' : tickText(value, decades);
        return {
            type: 'logarithmic', min: range[0], max: range[1],
            title: { display: true, text: title, color: color('soft') },
            border: { color: color('line') },
            grid: { color: (context) => text(context.tick.value) ? color('line') : 'transparent' },
            ticks: { color: color('soft'), autoSkip: false, maxRotation: 0, callback: text },
            ...more,
        };
    }

    const widened = (values, factor) => [Math.min(...values) / factor, Math.max(...values) * factor];

    function yRange(points, floor, hasZero) {
        const [low, high] = widened(points.map((point) => point.y), 1.8);
        return hasZero ? [floor / 1.8, Math.max(high, floor * 100)] : [low, high];
    }

    /* Draws the spread of the times and, where there are zeros, the line that they stand on. */
    const whiskers = {
        id: 'whiskers',
        beforeDatasetsDraw(chart, _, options) {
            const { ctx, chartArea: area, scales: { x, y } } = chart;
            ctx.save();
            ctx.lineWidth = 1;
            if (options.hasZero) {
                const level = y.getPixelForValue(options.floor);
                ctx.strokeStyle = ctx.fillStyle = color('soft');
                ctx.setLineDash([6, 4]);
                ctx.beginPath();
                ctx.moveTo(area.left, level);
                ctx.lineTo(area.right, level);
                ctx.stroke();
                ctx.setLineDash([]);
                ctx.font = '12px system-ui, sans-serif';
                ctx.textAlign = 'right';
                ctx.fillText('no error at all: 0, not a value of the axis', area.right - 6, level - 7);
            }
            for (const set of chart.data.datasets.filter((one) => !one.isFront)) {
                if (!chart.isDatasetVisible(chart.data.datasets.indexOf(set))) continue;
                ctx.strokeStyle = set.borderColor;
                for (const { run, y: value } of set.data) {
                    const level = y.getPixelForValue(value), { min, max } = run.ms;
                    if (!(min > 0) || !page.isNumber(max)) continue;
                    const ends = [min, max].map((time) => Math.min(Math.max(x.getPixelForValue(time), area.left), area.right));
                    ctx.beginPath();
                    ctx.moveTo(ends[0], level);
                    ctx.lineTo(ends[1], level);
                    for (const end of ends) ctx.moveTo(end, level - 4), ctx.lineTo(end, level + 4);
                    ctx.stroke();
                }
            }
            ctx.restore();
        },
    };

    /* What the hover says of a run, below its name. */
    page.hoverLines = function (point, figure) {
        const { ms, errors, frames } = point.run, settings = page.settings(point.run);
        return [
            settings || null,
            `time: ${page.ms(ms.median)} (${page.number(ms.min)} to ${page.number(ms.max)}, ${page.plural(frames, 'frame')})`,
            `${figure.title}: ${page.number(point.error)}`,
            `missed ${page.count(errors.missed)}, invented ${page.count(errors.invented)}, `
                + `wrong root ${page.count(errors.wrong_root)}, undecided ${page.count(errors.undecided)}`,
            `distance: median ${page.number(errors.t?.median)}, p99 ${page.number(errors.t?.p99)}, largest ${page.number(errors.t?.max)}`,
        ].filter((line) => line !== null);
    };

    function hover(callbacks) {
        return {
            backgroundColor: color('raised'), borderColor: color('line'), borderWidth: 1, padding: 10,
            titleColor: color('ink'), bodyColor: color('ink'), usePointStyle: true, callbacks,
        };
    }

    const legend = () => ({ position: 'bottom', labels: { color: color('ink'), usePointStyle: true, padding: 16 } });

    function drawErrors(figure) {
        page.errorChart?.destroy();
        page.errorChart = null;
        const { points, left, floor, hasZero } = page.pointsOf(figure);
        page.byId('error-note').textContent = left.length ? `Not drawn, because this figure does not exist there: ${left.join(', ')}.` : '';
        if (!points.length) return;
        page.front = page.frontOf(points);
        const times = points.flatMap(({ run: { ms } }) => [ms.min, ms.median, ms.max]).filter((time) => time > 0);
        const canvas = page.byId('error-chart');
        canvas.setAttribute('aria-label', `${figure.title}, against milliseconds a frame; the table of figures has the same numbers`);
        page.errorChart = new Chart(canvas, {
            type: 'line',
            data: { datasets: [...curves(points), frontSet(page.front)] },
            plugins: [whiskers],
            options: {
                animation: false, maintainAspectRatio: false,
                interaction: { mode: 'nearest', intersect: true },
                scales: {
                    x: logAxis('milliseconds a frame (median)', widened(times, 1.3)),
                    y: logAxis(figure.title, yRange(points, floor, hasZero), {
                        afterBuildTicks(axis) { // below the floor's neighbour nothing is a value
                            if (hasZero) axis.ticks = [{ value: floor }, ...axis.ticks.filter((tick) => tick.value > floor * 1.5)];
                        },
                    }, hasZero ? floor : undefined),
                },
                plugins: {
                    whiskers: { floor, hasZero },
                    legend: legend(),
                    tooltip: hover({
                        title: (items) => items.map((item) => item.raw.run?.name),
                        label: (item) => page.hoverLines(item.raw, figure),
                    }),
                },
            },
        });
    }

    /* [[phase, [ms of each run, ...]], ...]: phases that take any time at all. */
    page.phasesOf = function (runs) {
        const names = [...new Set(runs.flatMap((run) => Object.keys(run.ms.phases ?? {})))];
        return names.map((name) => [name, runs.map((run) => run.ms.phases?.[name] ?? 0)])
            .filter(([name, times]) => name !== 'total' && times.some((time) => time > 0));
    };

    function drawPhases(runs) {
        page.phaseChart?.destroy();
        page.byId('phase-box').style.height = `${7 + 2 * runs.length}rem`;
        const canvas = page.byId('phase-chart');
        canvas.setAttribute('aria-label', 'Milliseconds of each phase, a bar a run');
        page.phaseChart = new Chart(canvas, {
            type: 'bar',
            data: {
                labels: runs.map((run) => run.name),
                datasets: page.phasesOf(runs).map(([label, data], index) => ({
                    label, data, backgroundColor: curveColor(index), borderColor: color('back'), borderWidth: 1,
                    maxBarThickness: 24,
                })),
            },
            options: {
                indexAxis: 'y', animation: false, maintainAspectRatio: false,
                interaction: { mode: 'index', axis: 'y', intersect: false },
                scales: {
                    x: { stacked: true, title: { display: true, text: 'milliseconds', color: color('soft') },
                        border: { color: color('line') }, grid: { color: color('line') }, ticks: { color: color('soft') } },
                    y: { stacked: true, border: { color: color('line') }, grid: { display: false }, ticks: { color: color('ink') } },
                },
                plugins: {
                    legend: { ...legend(), labels: { color: color('ink'), boxWidth: 12, boxHeight: 12, padding: 14 } },
                    tooltip: { ...hover({ label: (item) => `${item.dataset.label}: ${page.ms(item.raw)}` }), usePointStyle: false,
                        filter: (item) => item.raw > 0 },
                },
            },
        });
    }

    function figureMenu(select) {
        const groups = [...new Set(page.errorFigures.map((figure) => figure.group))];
        const drawable = page.errorFigures.filter((figure) => page.pointsOf(figure).points.length);
        page.fill(select, groups.map((group) => [group, drawable.filter((figure) => figure.group === group)
            .map((figure) => [figure.key, figure.text])]).filter(([, figures]) => figures.length));
        const wanted = ['t.p99', 't.max', 'missed'].find((key) => drawable.some((figure) => figure.key === key));
        if (wanted) select.value = wanted;
    }

    page.startCharts = function () {
        if (!page.measured.length) return;
        page.show('errors');
        if (typeof Chart === 'undefined') {
            page.show('no-charts');
            for (const part of document.querySelectorAll('#errors .bar, #errors .canvas')) part.hidden = true;
            document.querySelector('#errors .canvas').remove();
            return;
        }
        const select = page.byId('figure');
        figureMenu(select);
        const phased = page.measured.filter((run) => Object.keys(run.ms.phases ?? {}).length);
        if (phased.length) page.show('phases');
        const draw = () => drawErrors(page.errorFigures.find((figure) => figure.key === select.value));
        const drawAll = () => {
            draw();
            if (phased.length) drawPhases(phased);
        };
        select.addEventListener('change', draw);
        matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawAll);
        drawAll();
    };
})(meniscus);
