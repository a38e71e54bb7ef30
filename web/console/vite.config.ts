import { defineConfig } from 'vitest/config';

// The gateway of `npm run dev`.
const gateway = process.env['ROIS_URL'] ?? 'http://127.0.0.1:8080';

/** A file for each panel, named after its folder, and one for their shared modules. */
function chunk_of(id: string): string | undefined {
  if (/\/web\/(client|node_modules)\//.test(id)) return 'shared';
  const folder = /\/console\/src\/(\w+)\//.exec(id)?.[1];
  return folder && ['ui', 'forms', 'state', 'shell', 'i18n'].includes(folder) ? 'shared' : folder;
}

export default defineConfig({
  // Writes only to dist/ and build/. Inlines nothing, because the page's security policy forbids it.
  cacheDir: 'build/vite',
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    rollupOptions: { output: { manualChunks: chunk_of } },
  },
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact' },
  // The included scenario is read from client-cpp/.
  server: { fs: { allow: ['../..'] }, proxy: { '/rois': { target: gateway, ws: true }, '/metrics': gateway, '/readyz': gateway } },
  test: {
    include: ['tests/**/*.test.{ts,tsx}'],
    environment: 'node',
    testTimeout: 60_000,
    hookTimeout: 60_000,
    expect: { poll: { timeout: 15_000 } }, // as long as a locator waits: the default of 1 s is too short on a busy machine
    fileParallelism: false,
  },
});
