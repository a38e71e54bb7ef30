// A TLS proxy before a gateway, with a self-signed certificate.
import { execFileSync } from 'node:child_process';
import { createHash, X509Certificate } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { connect, type Socket } from 'node:net';
import { tmpdir } from 'node:os';
import { createServer, type Server } from 'node:tls';

export class TlsProxy {
  private readonly sockets = new Set<Socket>();

  private constructor(
    private readonly folder: string,
    private readonly server: Server,
    target: number,
  ) {
    server.on('secureConnection', (near) => {
      const far = connect(target, '127.0.0.1');
      for (const [one, other] of [[near, far], [far, near]] as const) {
        this.sockets.add(one);
        one.setNoDelay(true);
        one.on('error', () => undefined);
        one.on('close', () => this.sockets.delete(one) && other.destroy());
        one.pipe(other);
      }
    });
  }

  /** The certificate is valid for `name`. */
  static async before(target: number, name = 'IP:127.0.0.1'): Promise<TlsProxy> {
    const folder = mkdtempSync(`${tmpdir()}/rois-tls-`);
    const made = ['-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-keyout', `${folder}/key.pem`, '-out', `${folder}/certificate.pem`];
    execFileSync('openssl', ['req', '-x509', '-days', '2', '-subj', '/CN=robot', '-addext', `subjectAltName=${name}`, ...made], { stdio: 'pipe' });
    const [key, cert] = [readFileSync(`${folder}/key.pem`), readFileSync(`${folder}/certificate.pem`)];
    const server = createServer({ key, cert }).listen(0, '127.0.0.1');
    await new Promise((resolve) => server.once('listening', resolve));
    return new TlsProxy(folder, server, target);
  }

  get port(): number {
    return (this.server.address() as { port: number }).port;
  }
  get url(): string {
    return `https://127.0.0.1:${this.port}`;
  }
  /** Path of the certificate. */
  get certificate(): string {
    return `${this.folder}/certificate.pem`;
  }
  /** The switch with which Chromium trusts the certificate. */
  get chromium_switch(): string {
    const key = new X509Certificate(readFileSync(this.certificate)).publicKey.export({ type: 'spki', format: 'der' });
    return `--ignore-certificate-errors-spki-list=${createHash('sha256').update(key).digest('base64')}`;
  }

  async stop(): Promise<void> {
    for (const socket of this.sockets) socket.destroy();
    await new Promise((resolve) => this.server.close(resolve));
    rmSync(this.folder, { recursive: true });
  }
}
