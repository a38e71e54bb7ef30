import { defineConfig } from 'vitest/config';

// Where `npm run dev` finds a gateway.
const gateway = process.env['ROIS_URL'] ?? 'http://127.0.0.1:8080';

export default defineConfig({
  // All that it writes is in dist/ and build/; nothing is inlined, since the page's policy forbids it.
  cacheDir: 'build/vite',
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    // A file for each panel, and one for what they share.
    rollupOptions: { output: { manualChunks: (id) => (/\/(ui|forms|state|shell|i18n|client|node_modules)\//.test(id) ? 'shared' : undefined) } },
  },
  esbuild: { jsx: 'transform', jsxFactory: 'h', jsxFragment: 'Fragment', jsxInject: "import { Fragment, h } from 'preact'" },
  // The shipped scenario is read where it stands, in client-cpp/.
  server: { fs: { allow: ['../..'] }, proxy: { '/rois': { target: gateway, ws: true }, '/metrics': gateway, '/readyz': gateway } },
  test: {
    include: ['tests/**/*.test.{ts,tsx}'],
    environment: 'node',
    testTimeout: 60_000,
    hookTimeout: 60_000,
    expect: { poll: { timeout: 15_000 } }, // as long as a locator waits: a second is too short on a machine that is busy
    fileParallelism: false,
  },
});
