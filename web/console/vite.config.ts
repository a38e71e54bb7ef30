import { defineConfig } from 'vitest/config';

// Where `npm run dev` finds a gateway.
const gateway = process.env['ROIS_URL'] ?? 'http://127.0.0.1:8080';

// Texts among texts are smaller with gzip than texts among code. Beneath both is what texts need.
function chunk(id: string): string {
  if (/node_modules|i18n\.ts$/.test(id)) return 'base';
  return /texts\.ts$|words\.ts$|\.xml\?raw$/.test(id) ? 'texts' : 'console';
}

export default defineConfig({
  // All that it writes is in dist/ and build/; nothing is inlined, since the page's policy forbids it.
  cacheDir: 'build/vite',
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    // What is below is so for the weight of the page with gzip; docs/console.md says what each brings.
    minify: 'terser',
    terserOptions: { module: true, ecma: 2020, compress: { passes: 2, inline: 1, lhs_constants: false } as object },
    rollupOptions: { output: { manualChunks: chunk } },
  },
  esbuild: { jsx: 'transform', jsxFactory: 'h', jsxFragment: 'Fragment', jsxInject: "import { Fragment, h } from 'preact'" },
  // The shipped scenario is read where it stands, in client-cpp/.
  server: { fs: { allow: ['../..'] }, proxy: { '/rois': { target: gateway, ws: true }, '/metrics': gateway, '/readyz': gateway } },
  test: {
    include: ['tests/**/*.test.{ts,tsx}'],
    environment: 'node',
    testTimeout: 60_000,
    hookTimeout: 60_000,
    fileParallelism: false,
  },
});
