import { defineConfig, devices } from '@playwright/test';

/** The browser: Debian's, or the one that ISOPHOTE_CHROMIUM names. It is kept off the network. */
const chromium = {
  executablePath: process.env['ISOPHOTE_CHROMIUM'] ?? '/usr/bin/chromium',
  args: [
    '--no-sandbox',
    '--disable-gpu',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
  ],
};

export const PORT = 4186;

export default defineConfig({
  testDir: 'e2e',
  outputDir: '../target/app-tests',
  timeout: 60_000,
  fullyParallel: true,
  workers: 2,
  reporter: process.env['CI'] ? 'line' : 'list',
  use: {
    ...devices['Desktop Chrome'],
    viewport: { width: 1366, height: 768 },
    baseURL: `http://127.0.0.1:${PORT}/`,
    locale: 'en-GB',
    launchOptions: chromium,
    acceptDownloads: true,
  },
  webServer: {
    command: `npx vite preview --outDir dist/site --port ${PORT} --strictPort --host 127.0.0.1`,
    url: `http://127.0.0.1:${PORT}/`,
    reuseExistingServer: false,
  },
});
