// A headless Chromium driven through its DevTools protocol over a pipe: messages are JSON, each ended by a zero byte.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const LOAD_LIMIT_MS = 60_000;

export class Browser {
    constructor(program) {
        this.profile = mkdtempSync(join(tmpdir(), 'meniscus-page-'));
        this.process = spawn(program, [
            '--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
            '--disable-background-networking', '--disable-component-update', '--disable-sync', '--hide-scrollbars',
            `--user-data-dir=${this.profile}`, '--remote-debugging-pipe', 'about:blank',
        ], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
        this.waiting = new Map();
        this.listeners = [];
        this.last = 0;
        let text = '';
        this.process.stdio[4].setEncoding('utf8').on('data', (chunk) => {
            const messages = (text + chunk).split('\0');
            text = messages.pop();
            messages.forEach((message) => this.#take(JSON.parse(message)));
        });
        this.process.on('exit', () => this.fail(new Error('Chromium ended')));
        this.process.on('error', (error) => this.fail(error));
        this.process.stdio[3].on('error', (error) => this.fail(error));
    }

    /* Ends all that is waited for. */
    fail(error) {
        this.failed ??= error;
        for (const { reject } of this.waiting.values()) reject(error);
        this.waiting.clear();
    }

    #take(message) {
        const one = this.waiting.get(message.id);
        if (!one) return this.listeners.forEach((listener) => listener(message));
        this.waiting.delete(message.id);
        if (message.error) one.reject(new Error(`${one.method}: ${message.error.message}`));
        else one.resolve(message.result);
    }

    send(method, params = {}, sessionId = undefined) {
        if (this.failed) return Promise.reject(this.failed);
        const id = ++this.last;
        return new Promise((resolve, reject) => {
            this.waiting.set(id, { resolve, reject, method });
            this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
        });
    }

    async close() {
        if (this.process.exitCode === null && this.process.pid) {
            const ended = new Promise((resolve) => this.process.once('exit', resolve));
            this.process.kill();
            await ended;
        }
        rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
    }

    /* Opens a file in a tab of its own, with what it says and asks for written down from the first byte on. */
    async open(path, { width, height, dark = false }) {
        const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
        const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
        const tab = new Tab(this, sessionId);
        for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await tab.send(`${domain}.enable`);
        await tab.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
        await tab.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }] });
        const loaded = tab.event('Page.loadEventFired');
        await tab.send('Page.navigate', { url: pathToFileURL(path).href });
        await loaded;
        return tab;
    }
}

class Tab {
    constructor(browser, sessionId) {
        Object.assign(this, { browser, sessionId, complaints: [], requests: [] });
        browser.listeners.push((message) => {
            if (message.sessionId === sessionId) this.#note(message);
        });
    }

    #note({ method, params }) {
        if (method === 'Runtime.exceptionThrown') this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
        if (method === 'Runtime.consoleAPICalled') this.complaints.push(`console.${params.type}: ${params.args.map((a) => a.value ?? a.description).join(' ')}`);
        if (method === 'Log.entryAdded') this.complaints.push(`${params.entry.level}: ${params.entry.text}`);
        if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
        if (method === 'Page.javascriptDialogOpening') this.complaints.push(`a dialog: ${params.message}`);
    }

    send(method, params) {
        return this.browser.send(method, params, this.sessionId);
    }

    event(name) {
        return new Promise((resolve, reject) => {
            const late = setTimeout(() => reject(new Error(`${name} did not come`)), LOAD_LIMIT_MS);
            this.browser.listeners.push(({ method, sessionId }) => {
                if (method !== name || sessionId !== this.sessionId) return;
                clearTimeout(late);
                resolve();
            });
        });
    }

    /* The value of a function that runs in the page; its arguments and its value travel as JSON. */
    async run(code, ...values) {
        const expression = `(${code})(${values.map((value) => JSON.stringify(value)).join(', ')})`;
        const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    }

    /* Until what was changed has been drawn: before, the mouse may still meet what stood there. */
    settle() {
        return this.run(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0)))));
    }

    /* Where the middle of an element stands in the window, scrolled into it, and its size. */
    async box(selector) {
        await this.run((wanted) => document.querySelector(wanted).scrollIntoView({ block: 'center' }), selector);
        await this.settle();
        return this.run((wanted) => {
            const element = document.querySelector(wanted);
            const { left, top, width, height } = element.getBoundingClientRect();
            return { left, top, width, height, x: left + width / 2, y: top + height / 2 };
        }, selector);
    }

    async mouse(type, x, y, buttons) {
        await this.send('Input.dispatchMouseEvent', { type, x, y, buttons, button: type === 'mouseMoved' ? 'none' : 'left', clickCount: type === 'mouseMoved' ? 0 : 1 });
    }

    async drag(from, to) {
        await this.mouse('mouseMoved', from.x, from.y, 0);
        await this.mouse('mousePressed', from.x, from.y, 1);
        for (const part of [0.5, 1]) await this.mouse('mouseMoved', from.x + part * (to.x - from.x), from.y + part * (to.y - from.y), 1);
        await this.mouse('mouseReleased', to.x, to.y, 0);
    }

    async click(selector) {
        const { x, y } = await this.box(selector);
        await this.drag({ x, y }, { x, y });
    }

    async key(key) {
        await this.send('Input.dispatchKeyEvent', { type: 'keyDown', key });
        await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key });
    }

    choose(selector, value) {
        return this.run((wanted, chosen) => {
            const select = document.querySelector(wanted);
            select.value = chosen;
            select.dispatchEvent(new Event('change', { bubbles: true }));
            return select.value;
        }, selector, value);
    }

    async picture(path) {
        await this.run(() => scrollTo(0, 0));
        const { cssContentSize } = await this.send('Page.getLayoutMetrics');
        const clip = { x: 0, y: 0, width: cssContentSize.width, height: cssContentSize.height, scale: 1 };
        const { data } = await this.send('Page.captureScreenshot', { clip, captureBeyondViewport: true });
        writeFileSync(path, Buffer.from(data, 'base64'));
    }
}
